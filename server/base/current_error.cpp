#include "server/base/current_error.hpp"

#include <spdlog/spdlog.h>

#include <new>

#include "core/base/error.hpp"
#include "proto/error_codes.hpp"
#include "server/base/storage_error.hpp"

namespace sculpt::server {

Json current_error() {
  try {
    throw;
  } catch (const proto::ProtocolError& error) {
    return proto::error_object(error.code(), error.what(), error.pointer());
  } catch (const InputError& error) {
    return proto::error_object(error.code(), error.what());
  } catch (const Cancelled&) {
    return proto::error_object("stopping", "the daemon is stopping: try again when it is back");
  } catch (const StorageFull& error) {
    return proto::error_object("storage_full", error.what());
  } catch (const DatabaseUnavailable& error) {
    return proto::error_object("db_unavailable", error.what());
  } catch (const StorageError& error) {
    spdlog::error("{}", error.what());
    return proto::error_object("storage_error", error.what());
  } catch (const std::bad_alloc&) {
    return proto::error_object("out_of_memory",
                               "the server has not enough memory for this: use a smaller resolution or mesh");
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
    return proto::error_object("internal_error", std::string("the server failed: ") + error.what());
  }
}

}  // namespace sculpt::server
