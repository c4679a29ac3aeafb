#include "server/handlers.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

Answer blob_answer(const std::string& sha256, const BlobState& state) {
  return {{{"sha256", sha256}, {"have", state.have}, {"complete", state.complete}}, std::nullopt};
}

}  // namespace

void on_blob_has(Services& services, Call call) {
  const std::string sha256 = read_blob_name(call.params);
  call.session->hold();
  answer_from(services.disk, services, std::move(call), [&blobs = services.blobs, sha256](const std::stop_token&) {
    return blob_answer(sha256, blobs.use(sha256));
  });
}

void on_blob_put(Services& services, Call call) {
  const BlobPutParams put = read_blob_put(call.params);
  call.session->hold();
  const auto chunk = std::make_shared<const std::string>(std::move(call.chunk));
  answer_from(services.disk, services, std::move(call), [&blobs = services.blobs, put, chunk](const std::stop_token&) {
    return blob_answer(put.sha256, blobs.put(put.sha256, put.size, put.offset, *chunk));
  });
}

}  // namespace sculpt
