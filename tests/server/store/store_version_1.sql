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
INSERT INTO "artifact" VALUES(1,3,'report','json',903,'329d950be59a5d3ab2f1e87a1d46cafebc3abe2638556f440630e3f367cd8f43');
CREATE TABLE event(
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  PRIMARY KEY(job, seq)) STRICT, WITHOUT ROWID;
INSERT INTO "event" VALUES(1,1,'2026-11-21T14:30:46.124Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(1,2,'2026-11-21T14:30:46.138Z','running','{"from":"queued","to":"running","attempt":1,"reason":"claimed"}');
INSERT INTO "event" VALUES(1,3,'2026-11-21T14:30:46.182Z','succeeded','{"from":"running","to":"succeeded","attempt":1,"reason":"finished"}');
INSERT INTO "event" VALUES(2,1,'2026-11-21T14:30:46.240Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(2,2,'2026-11-21T14:30:46.248Z','running','{"from":"queued","to":"running","attempt":1,"reason":"claimed"}');
INSERT INTO "event" VALUES(3,1,'2026-11-21T14:30:48.319Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(4,1,'2026-11-21T14:30:48.380Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(5,1,'2026-11-21T14:30:48.454Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(5,2,'2026-11-21T14:30:48.534Z','cancelled','{"from":"queued","to":"cancelled","reason":"cancel_requested"}');
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
  error_sentence TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "job" VALUES(1,'01M7Z88KKC6557GD2AF0NKGAC8','succeeded',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',1,'2026-11-21T14:30:46.124Z','2026-11-21T14:30:46.138Z','2026-11-21T14:30:46.182Z','','');
INSERT INTO "job" VALUES(2,'01M7Z88KPZZPQKQ83NYNXV44VP','running',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"panda-turntable","resolution":64,"search":"octree"}','9c7322517777665872e4e43834926affcdad9f78c3c050e74673a96f698ecc8c',1,'2026-11-21T14:30:46.239Z','2026-11-21T14:30:46.248Z','','','');
INSERT INTO "job" VALUES(3,'01M7Z88NQZ1S3S05QW8BM7MDK6','queued','order 1',0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T14:30:48.319Z','','','','');
INSERT INTO "job" VALUES(4,'01M7Z88NSWF9T53DZSAGGNHR1F','queued','order 2',5,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T14:30:48.380Z','','','','');
INSERT INTO "job" VALUES(5,'01M7Z88NW6NC005SCJZ44B12G4','cancelled',NULL,0,'{"mesh":{"blob":"a785e7c374f8729a2e6435f5ddfade35f33be1cf81f2b198ff281cd16c29eb26","name":"bust.stl"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-21T14:30:48.454Z','','2026-11-21T14:30:48.534Z','','');
CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
INSERT INTO "meta" VALUES('epoch','01M7Z88KGJBTZDB219QR92F322');
CREATE INDEX job_queue ON job(state, priority DESC, number);
COMMIT;
PRAGMA user_version=1;
