// Wire structs -> core structs: the only file pair that knows both.
#pragma once

#include "core/plan/intake.hpp"
#include "core/plan/plan.hpp"
#include "core/program/program_demands.hpp"
#include "proto/cell_bundle.hpp"
#include "proto/job_spec.hpp"
#include "proto/motion/program_spec.hpp"
#include "server/files/blobs.hpp"

namespace sculpt::server {

/// What a spec may leave open.
struct JobDefaults {
  int threads = 1;
  std::uint64_t memory_cap_bytes = 2ull << 30;
};

/// Of a file by its name: "stl" of "a.STL", "" where there is none.
std::string mesh_kind(const std::string& name);

/// What the job would take, before anything but the list of the cell's files is read. Each file that the list names
/// counts, as often as it does. Throws as to_job.
JobSizes measure(const proto::JobSpec& spec, const std::string& cell_bundle, const Blobs& blobs);

/// Loads every blob that the spec refers to; `cell_bundle` is the hash of the cell's bundle. Throws ProtocolError
/// `blob_missing` or `params_invalid`.
Job to_job(const proto::JobSpec& spec, const std::string& cell_bundle, const Blobs& blobs, const JobDefaults& defaults);

/// All but how fast: a job's `motion` says that. Throws InputError `dialect_unknown`.
ProgramDemands to_program_demands(const proto::ProgramSpec& spec);

/// Bytes of a cell: its file and, as often as it names them, its other files. `pointer`: of the bundle's hash, for
/// errors.
std::uint64_t measure_cell(const std::string& cell_bundle, const Blobs& blobs, const std::string& pointer);

/// The files of a cell. Throws ProtocolError `blob_missing`, `params_invalid`, `too_large`.
CellFiles load_cell(const std::string& cell_bundle, const Blobs& blobs, const std::string& pointer);

/// Stores the files of a cell as blobs and returns the hash of their bundle.
std::string store_cell(const CellFiles& files, Blobs& blobs);

}  // namespace sculpt::server
