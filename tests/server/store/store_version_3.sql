BEGIN TRANSACTION;
CREATE TABLE artifact(
  job INTEGER NOT NULL REFERENCES job(number),
  place INTEGER NOT NULL,
  artifact TEXT NOT NULL,
  format TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY(job, place)) STRICT, WITHOUT ROWID;
INSERT INTO "artifact" VALUES(1,0,'trajectory','ndjson',22392,'164d0d2ca31af3f8276b313e5f6ae1259d5c08aaa52cdc114964793740bcb506');
INSERT INTO "artifact" VALUES(1,1,'voxels','binvox',217,'311bfd37bff3cca79fdd6498fe71ce91163b02ebf55a7ab44b97b44d66e22278');
INSERT INTO "artifact" VALUES(1,2,'residue','ndjson',0,'e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855');
INSERT INTO "artifact" VALUES(1,3,'report','json',905,'ea5dd394e9c10133711c04b82c5053e0a18348722ea7de46b6b89b44d0494840');
CREATE TABLE event(
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  PRIMARY KEY(job, seq)) STRICT, WITHOUT ROWID;
INSERT INTO "event" VALUES(1,1,'2026-11-22T11:17:39.939Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(1,2,'2026-11-22T11:17:39.947Z','running','{"from":"queued","to":"running","reason":"claimed","attempt":1}');
INSERT INTO "event" VALUES(1,3,'2026-11-22T11:17:40.519Z','succeeded','{"from":"running","to":"succeeded","reason":"finished","attempt":1}');
INSERT INTO "event" VALUES(2,1,'2026-11-22T11:17:40.584Z','held','{"to":"held","reason":"submitted","until":"2031-01-01T00:00:00.000Z"}');
INSERT INTO "event" VALUES(2,2,'2026-11-22T11:17:39.938Z','cancelled','{"from":"held","to":"cancelled","reason":"cancel_requested"}');
INSERT INTO "event" VALUES(3,1,'2026-11-22T11:17:40.644Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(3,2,'2026-11-22T11:17:40.655Z','running','{"from":"queued","to":"running","reason":"claimed","attempt":1}');
INSERT INTO "event" VALUES(4,1,'2026-11-22T11:17:40.716Z','queued','{"to":"queued","reason":"submitted"}');
INSERT INTO "event" VALUES(5,1,'2026-11-22T11:17:40.722Z','held','{"to":"held","reason":"submitted","until":"2031-01-01T00:00:00.000Z"}');
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
INSERT INTO "job" VALUES(1,'01M81FKQZ2Y999AWG75R8YJM6H','succeeded',NULL,0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8,"search":"octree"}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',1,'2026-11-22T11:17:39.938Z','2026-11-22T11:17:39.947Z','2026-11-22T11:17:40.519Z','','','','',0,4196019,1795346259938,0,0,0,'',1,'');
INSERT INTO "job" VALUES(2,'01M81FKRK8JGBVGZ6BKBZGFZBX','cancelled','order 3',2,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8,"search":"octree"}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-22T11:17:40.584Z','','2026-11-22T11:17:39.938Z','','','2031-01-01T00:00:00.000Z','',0,4196019,1795346140584,0,0,0,'',0,'');
INSERT INTO "job" VALUES(3,'01M81FKRN3B4C1BFN6K2XX8BN6','running',NULL,0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"panda-turntable","resolution":128,"search":"octree"}','9c7322517777665872e4e43834926affcdad9f78c3c050e74673a96f698ecc8c',1,'2026-11-22T11:17:40.643Z','2026-11-22T11:17:40.655Z','','','','','',0,7550643,1795346260643,0,1,0,'',0,'');
INSERT INTO "job" VALUES(4,'01M81FKRQC3ZBWS8QBNCS0XEMH','queued','order 1',0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8,"search":"octree"}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-22T11:17:40.716Z','','','','','','',0,4196019,1795346260716,0,0,0,'',0,'');
INSERT INTO "job" VALUES(5,'01M81FKRQH9JCECPGZT8SNWZH9','held','order 2',0,'{"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},"robot":"gantry","resolution":8,"search":"octree"}','0b560666f383613b4b7ad951235105c7511032ee4900bc091b4b43641db5be5b',0,'2026-11-22T11:17:40.721Z','','','','','2031-01-01T00:00:00.000Z','',0,4196019,1795346260721,0,0,0,'2031-01-01T00:00:00.000Z',0,'');
CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
INSERT INTO "meta" VALUES('epoch','01M81FKPREQ44RCAMG06AXEZ20');
INSERT INTO "meta" VALUES('queue_paused','1');
CREATE TABLE removed(id TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
INSERT INTO "removed" VALUES('01M81FKPXJ45AA00VNDSBJGSD1');
CREATE INDEX job_queue ON job(state, rank, number);
CREATE INDEX job_start_by ON job(start_by) WHERE start_by <> '';
CREATE INDEX job_owner ON job(owner, state);
COMMIT;
PRAGMA user_version=3;
