// The bulk of a Client: blobs up, artifacts down, each held against its hash.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <ostream>
#include <thread>

#include "clients/cpp/client.hpp"
#include "clients/cpp/content_hash.hpp"
#include "proto/cell_bundle.hpp"
#include "proto/crc32.hpp"

namespace sculpt::client {
namespace {

constexpr std::size_t upload_bytes = 1 << 20;
constexpr int damage_number = 4003;                     // of artifact_damaged
constexpr std::chrono::milliseconds growth_pause{100};  // between looks at an artifact that has not grown

// What the artifact's form must hash to, as artifact.list says it; empty: it does not.
std::string listed_hash(const Json& listed, const std::string& artifact, const std::string& format) {
  for (const Json& entry : listed.at("artifacts")) {
    if (entry.at("artifact") != artifact) continue;
    if (entry.at("formats").at(0) == format) return entry.value("sha256", std::string());
    for (const Json& made : entry.value("made", Json::array()))
      if (made.at("format") == format) return made.at("sha256");
  }
  return {};
}

}  // namespace

void Client::put_chunk(const std::string& sha256, std::uint64_t size, std::uint64_t& offset, std::string_view chunk) {
  const std::string method = "blob.put";
  const Json params{{"sha256", sha256}, {"size", size}, {"offset", offset}, {"bytes", chunk.size()}};
  offset = exchange({method, params, chunk, nullptr}).at("have").get<std::uint64_t>();
}

void Client::put_blob(const std::string& sha256, std::uint64_t size, const ReadPiece& read) {
  const Json state = call("blob.has", {{"sha256", sha256}});
  if (state.at("complete").get<bool>()) return;
  auto offset = std::min<std::uint64_t>(state.at("have").get<std::uint64_t>(), size);
  bool again = true;
  do {
    try {
      put_chunk(sha256, size, offset, read(offset, std::min<std::uint64_t>(upload_bytes, size - offset)));
    } catch (const ServerError& error) {
      // What it has was uploaded by somebody who says that the blob is of another size.
      if (error.code() != "offset_mismatch" || !std::exchange(again, false)) throw;
      offset = 0;
    }
  } while (offset < size);
}

std::string Client::upload(std::string_view bytes) {
  std::string sha256 = content_hash(bytes);
  put_blob(sha256, bytes.size(),
           [bytes](std::uint64_t offset, std::size_t size) { return bytes.substr(offset, size); });
  return sha256;
}

std::string Client::upload_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read the file '" + path.string() + "'");
  const StreamHash hash = content_hash(in);
  std::string piece;
  put_blob(hash.sha256, hash.size, [&](std::uint64_t offset, std::size_t size) -> std::string_view {
    piece.resize(size);
    in.clear();
    in.seekg(static_cast<std::streamoff>(offset));
    if (!in.read(piece.data(), static_cast<std::streamsize>(size))) {
      throw std::runtime_error("cannot read the file '" + path.string() + "': it changed while it was sent");
    }
    return piece;
  });
  return hash.sha256;
}

std::uint64_t Client::read_artifact(const ArtifactRequest& request, std::ostream& out,
                                    const std::function<bool()>& waiting) {
  const std::string method = "artifact.read";
  Json params{{"job", request.job}, {"artifact", request.artifact}};
  if (!request.format.empty()) params["format"] = request.format;
  if (!request.program.is_null()) params["program"] = request.program;
  std::uint64_t offset = request.offset;
  std::string chunk;
  ContentHash hash;
  while (true) {
    params["offset"] = offset;
    params["bytes"] = request.chunk_bytes;
    const Json result = exchange({method, params, {}, &chunk});
    if (proto::crc32_hex(chunk) != result.at("crc32").get<std::string>()) {
      throw ServerUnreachable("a chunk of the artifact was damaged on its way: fetch again");
    }
    hash.add(chunk);
    out.write(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    if (!out) throw std::runtime_error("cannot write the artifact: check the free space");
    offset += chunk.size();
    if (result.at("eof").get<bool>()) {
      if (request.offset == 0) expect_hash(request, result, hash.hex());
      return offset;
    }
    if (!chunk.empty()) continue;
    if (waiting && !waiting()) return offset;
    std::this_thread::sleep_for(growth_pause);
  }
}

void Client::expect_hash(const ArtifactRequest& request, const Json& last, const std::string& sha256) {
  const std::string wanted = last.contains("sha256") ? last.at("sha256").get<std::string>()
                                                     : listed_hash(call("artifact.list", {{"job", request.job}}),
                                                                   request.artifact, last.at("format"));
  if (wanted.empty() || wanted == sha256) return;
  throw ServerError("artifact_damaged", damage_number, false, {},
                    "the " + request.artifact + " of job " + request.job + " came with the hash " + sha256 +
                        ", but was stored with " + wanted + ": fetch it again, or plan it again with 'sculpt retry " +
                        request.job + "'");
}

std::string Client::read_cell_file(const std::string& job, const std::string& sha256) {
  const std::string method = "job.cell";
  Json params{{"job", job}, {"offset", 0}, {"bytes", upload_bytes}};
  if (!sha256.empty()) params["file"] = sha256;
  std::string bytes, chunk;
  while (true) {
    const Json result = exchange({method, params, {}, &chunk});
    bytes += chunk;
    params["offset"] = bytes.size();
    if (!result.at("eof").get<bool>()) continue;
    if (content_hash(bytes) != result.at("file").get<std::string>())
      throw ServerUnreachable("a file of the cell was damaged on its way: ask again");
    return bytes;
  }
}

JobCell Client::read_cell(const std::string& job) {
  const proto::CellBundle bundle = proto::read_cell_bundle(read_cell_file(job, {}));
  JobCell cell{bundle.name, bundle.cell_json, {}};
  for (const auto& [reference, sha256] : bundle.files) cell.files[reference] = read_cell_file(job, sha256);
  return cell;
}

}  // namespace sculpt::client
