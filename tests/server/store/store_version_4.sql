BEGIN TRANSACTION;
CREATE TABLE artifact(
  job INTEGER NOT NULL REFERENCES job(number),
  place INTEGER NOT NULL,
  artifact TEXT NOT NULL,
  format TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY(job, place)) STRICT, WITHOUT ROWID;
INSERT INTO "artifact" VALUES(1,0,'trajectory','ndjson',22404,'4ecac068ba5271c2c07d5edbdb054ce96056081df547e1008c2c52e2f319c763');
INSERT INTO "artifact" VALUES(1,1,'voxels','binvox',217,'311bfd37bff3cca79fdd6498fe71ce91163b02ebf55a7ab44b97b44d66e22278');
INSERT INTO "artifact" VALUES(1,2,'residue','ndjson',0,'e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855');
INSERT INTO "artifact" VALUES(1,3,'report','json',955,'fe27a1fd6184bb5bf1ceb7a25846400e5919259b345d3eefec47301e080758ab');
CREATE TABLE "event"(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  UNIQUE(job, seq)) STRICT;
INSERT INTO "event" VALUES(1,1,1,'2026-11-22T20:38:59.909Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(2,1,2,'2026-11-22T20:38:59.921Z','running','{"from":"queued","to":"running","reason":"claimed","attempt":1}');
INSERT INTO "event" VALUES(3,1,3,'2026-11-22T20:39:00.010Z','succeeded','{"from":"running","to":"succeeded","reason":"finished","attempt":1}');
INSERT INTO "event" VALUES(4,2,1,'2026-11-22T20:39:00.014Z','held','{"to":"held","reason":"submitted","until":"2031-01-01T00:00:00.000Z"}');
INSERT INTO "event" VALUES(5,3,1,'2026-11-22T20:39:00.015Z','held','{"to":"held","reason":"submitted","until":"2031-01-01T00:00:00.000Z"}');
INSERT INTO "event" VALUES(6,3,2,'2026-11-22T20:39:00.016Z','cancelled','{"from":"held","to":"cancelled","reason":"cancel_requested"}');
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
  error_sentence TEXT NOT NULL DEFAULT '', not_before TEXT NOT NULL DEFAULT '', start_by TEXT NOT NULL DEFAULT '', max_runtime_s INTEGER NOT NULL DEFAULT 0, memory_bytes INTEGER NOT NULL DEFAULT 0, rank INTEGER NOT NULL DEFAULT 0, failures INTEGER NOT NULL DEFAULT 0, crashes INTEGER NOT NULL DEFAULT 0, isolated INTEGER NOT NULL DEFAULT 0, wake_at TEXT NOT NULL DEFAULT '', pinned INTEGER NOT NULL DEFAULT 0, owner TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "job" VALUES(1,'01M82FQJJ5WZGY5S17AB066JRT','succeeded','order 1',0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',1,'2026-11-22T20:38:59.909Z','2026-11-22T20:38:59.921Z','2026-11-22T20:39:00.010Z','','','','',0,4219693,1795379939909,0,0,1,'',1,'');
INSERT INTO "job" VALUES(2,'01M82FQJNEZHWY5S1CVKX01P4H','held','order 2',0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-22T20:39:00.014Z','','','','','2031-01-01T00:00:00.000Z','',0,4219693,1795379940014,0,0,0,'2031-01-01T00:00:00.000Z',0,'');
INSERT INTO "job" VALUES(3,'01M82FQJNFBT80Q6AM3AG9J4DG','cancelled',NULL,0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-22T20:39:00.015Z','','2026-11-22T20:39:00.016Z','','','2031-01-01T00:00:00.000Z','',0,4219693,1795379940015,0,0,0,'',0,'');
CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
INSERT INTO "meta" VALUES('epoch','01M82FQJD15P426HDHGW3E8Q3B');
INSERT INTO "meta" VALUES('changes','6');
CREATE TABLE removed(id TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE INDEX job_queue ON job(state, rank, number);
CREATE INDEX job_start_by ON job(start_by) WHERE start_by <> '';
CREATE INDEX job_owner ON job(owner, state);
DELETE FROM "sqlite_sequence";
INSERT INTO "sqlite_sequence" VALUES('event',6);
COMMIT;
PRAGMA user_version=4;
