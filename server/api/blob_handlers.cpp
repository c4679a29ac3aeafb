// What clients say of uploads.
#include "server/api/handlers.hpp"

namespace sculpt::server {
namespace {

Answer blob_answer(const std::string& sha256, const BlobState& state) {
  return {{{"sha256", sha256}, {"have", state.have}, {"complete", state.complete}}, std::nullopt};
}

void on_blob_has(const BlobGroup& group, Call call) {
  const std::string sha256 = proto::read_blob_name(call.params);
  call.session->hold();
  group.answers.from(group.disk, std::move(call), [&blobs = group.blobs, sha256](const std::stop_token&) {
    return blob_answer(sha256, blobs.use(sha256));
  });
}

void on_blob_put(const BlobGroup& group, Call call) {
  const proto::BlobPutParams put = proto::read_blob_put(call.params);
  call.session->hold();
  const auto chunk = std::make_shared<const std::string>(std::move(call.chunk));
  group.answers.from(group.disk, std::move(call), [&blobs = group.blobs, put, chunk](const std::stop_token&) {
    return blob_answer(put.sha256, blobs.put(put.sha256, put.size, put.offset, *chunk));
  });
}

}  // namespace

Handlers blob_handlers(const BlobGroup& group) {
  return {
      {"blob.has", [group](Call call) { on_blob_has(group, std::move(call)); }},
      {"blob.put", [group](Call call) { on_blob_put(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
