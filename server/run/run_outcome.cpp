#include "server/run/run_outcome.hpp"

#include <new>
#include <system_error>

#include "core/base/error.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

Ending failed_with(const std::string& code, const std::string& sentence, Cause cause = Cause::job) {
  return {JobState::failed, code, sentence, {}, cause};
}

}  // namespace

std::optional<Ending> caught_ending() {
  try {
    throw;
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const InputError& error) {
    // There may be space again.
    return failed_with(error.code(), error.what(), error.code() == "file_unwritable" ? Cause::fault : Cause::job);
  } catch (const SyncError& error) {
    end_after_failed_sync(error.what());
  } catch (const std::bad_alloc&) {
    return failed_with("out_of_memory",
                       "the planner ran out of memory: use a smaller resolution or mesh, or fewer workers",
                       Cause::fault);
  } catch (const StorageError& error) {
    return failed_with("storage_error", error.what(), Cause::fault);
  } catch (const CrashError& error) {
    return failed_with("planner_crashed", error.what(), Cause::crash);
  } catch (const std::system_error& error) {
    return failed_with("internal_error", std::string("the system refused: ") + error.what(), Cause::fault);
  } catch (const std::exception& error) {
    return failed_with("internal_error", std::string("the planner failed: ") + error.what());
  } catch (...) {
    return failed_with("internal_error", "the planner failed with something that is no exception");
  }
}

}  // namespace sculpt::server
