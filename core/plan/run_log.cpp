#include "core/plan/run_log.hpp"

#include "core/base/error.hpp"

namespace sculpt {

void RunLog::go_on() {
  if (now.file.bytes > 0) earlier_checks_ = now.checks - scene_.checks();
}

void RunLog::note() {
  if (!keeps()) return;
  output.mark();
  now.checks = checks();
  note_state();
}

void RunLog::note_state() {
  unsaved_ = keeps();
}

void RunLog::save() {
  if (!unsaved_) return;
  now.file = output.sync();
  kept_.save(now);
  unsaved_ = false;
}

void RunLog::save_if_due() {
  if (due()) save();
}

void RunLog::save_at_stop() {
  try {
    save();
  } catch (const InputError&) {
  }
}

}  // namespace sculpt
