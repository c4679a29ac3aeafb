BEGIN TRANSACTION;
CREATE TABLE artifact(
  job INTEGER NOT NULL REFERENCES job(number),
  place INTEGER NOT NULL,
  artifact TEXT NOT NULL,
  format TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY(job, place)) STRICT, WITHOUT ROWID;
INSERT INTO "artifact" VALUES(1,0,'trajectory','ndjson',30513,'1ccce272ba745dc2d5c4b3ebf9f150848839b8ba1af407f1f7a4128030319cb9');
INSERT INTO "artifact" VALUES(1,1,'voxels','binvox',219,'0b3e9dbae6baa5c46bbbda9cec32f0f4fe15b18b8dba232efc94f0cc10fd051b');
INSERT INTO "artifact" VALUES(1,2,'residue','ndjson',0,'e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855');
INSERT INTO "artifact" VALUES(1,3,'report','json',905,'2151a53a8b01598e6257e250482f73a04488a0abceb02d5b220ac814b6838e7f');
CREATE TABLE event(
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  PRIMARY KEY(job, seq)) STRICT, WITHOUT ROWID;
INSERT INTO "event" VALUES(1,1,'2026-11-21T15:54:14.656Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(1,2,'2026-11-21T15:54:14.671Z','running','{"from":"queued","to":"running","reason":"claimed","attempt":1}');
INSERT INTO "event" VALUES(1,3,'2026-11-21T15:54:14.931Z','succeeded','{"from":"running","to":"succeeded","reason":"finished","attempt":1}');
INSERT INTO "event" VALUES(2,1,'2026-11-21T15:54:15.262Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(2,2,'2026-11-21T15:54:15.274Z','running','{"from":"queued","to":"running","reason":"claimed","attempt":1}');
INSERT INTO "event" VALUES(3,1,'2026-11-21T15:54:16.888Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(4,1,'2026-11-21T15:54:17.663Z','held','{"to":"held","reason":"submitted","until":"2031-01-01T00:00:00.000Z"}');
INSERT INTO "event" VALUES(5,1,'2026-11-21T15:54:18.081Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(5,2,'2026-11-21T15:54:18.414Z','cancelled','{"from":"queued","to":"cancelled","reason":"cancel_requested"}');
CREATE TABLE job(
  number INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  state TEXT NOT NULL,
  key TEXT UNIQUE,
  priority INTEGER NOT NULL,
  spec TEXT NOT NULL,
  cell_bundle TEXT NOT NULL,
  attempt INTEGER NOT NULL DEFAULT 0,
  submitted_at TEXT NOT NULL,
  started_at TEXT NOT NULL DEFAULT '',
  finished_at TEXT NOT NULL DEFAULT '',
  error_code TEXT NOT NULL DEFAULT '',
  error_sentence TEXT NOT NULL DEFAULT '', not_before TEXT NOT NULL DEFAULT '', start_by TEXT NOT NULL DEFAULT '', max_runtime_s INTEGER NOT NULL DEFAULT 0, memory_bytes INTEGER NOT NULL DEFAULT 0, rank INTEGER NOT NULL DEFAULT 0, failures INTEGER NOT NULL DEFAULT 0, crashes INTEGER NOT NULL DEFAULT 0, isolated INTEGER NOT NULL DEFAULT 0, wake_at TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "job" VALUES(1,'01M7ZD1ER06667WEP120VG7WK4','succeeded',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',1,'2026-11-21T15:54:14.656Z','2026-11-21T15:54:14.671Z','2026-11-21T15:54:14.931Z','','','','',0,10290069,1795276454656,0,0,0,'');
INSERT INTO "job" VALUES(2,'01M7ZD1FAYFH84SDA0NB7716S2','running',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"panda-turntable","resolution":64}','9c7322517777665872e4e43834926affcdad9f78c3c050e74673a96f698ecc8c',1,'2026-11-21T15:54:15.262Z','2026-11-21T15:54:15.274Z','','','','','',0,10708680,1795276455262,0,1,0,'');
INSERT INTO "job" VALUES(3,'01M7ZD1GXQ2JR61GSNBP5F6TRW','queued','order 1',0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T15:54:16.887Z','','','','','','',0,10290069,1795276456887,0,0,0,'');
INSERT INTO "job" VALUES(4,'01M7ZD1HNZ4S7DZN1SMYT00GRJ','held','order 2',0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T15:54:17.663Z','','','','','2031-01-01T00:00:00.000Z','',0,10290069,1795276457663,0,0,0,'2031-01-01T00:00:00.000Z');
INSERT INTO "job" VALUES(5,'01M7ZD1J304HJQ8FVYAQEA3CM0','cancelled',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T15:54:18.080Z','','2026-11-21T15:54:18.414Z','','','','',0,10290069,1795276458080,0,0,0,'');
CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
INSERT INTO "meta" VALUES('epoch','01M7ZD1DA5WTXE4BBXGP8TXEHG');
CREATE INDEX job_queue ON job(state, rank, number);
CREATE INDEX job_start_by ON job(start_by) WHERE start_by <> '';
COMMIT;
PRAGMA user_version=2;
