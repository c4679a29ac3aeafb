#include "core/plan/run_log.hpp"

#include <utility>

#include "core/base/error.hpp"

namespace sculpt {

SweepListener RunLog::hear_sweep() {
  return {[this](std::vector<Keyframe> keyframes) { output_.add(std::move(keyframes)); }, [this] { go_on(); },
          [this](const SweepMemory& memory) {
            if (kept_.keeps()) now_.sweeping = memory;
            note();
            save_if_due();
          }};
}

/// Keyframes are written down only when a checkpoint is due: there are too many of them.
GantryListener RunLog::hear_gantry() {
  return {[this](const Keyframe& keyframe) {
            output_.add(keyframe);
            if (!kept_.due()) return;
            note();
            save();
          },
          [this](const Refusal& refusal) { now_.refusals.push_back(refusal); }, [this] { go_on(); },
          [this] { note(); }};
}

ArmListener RunLog::hear_arm() {
  return {[this](const Keyframe& keyframe) { output_.add(keyframe); },
          [this](const BlockTrial& trial, const ArmMemory& memory) {
            if (trial.removed > 0) output_.flush();
            now_.trials.push_back(trial);
            if (kept_.keeps()) now_.arm = memory;
            note();
            save_if_due();
          }};
}

MillListener RunLog::hear_mill() {
  return {[this](std::vector<Keyframe> keyframes) {
            output_.add(std::move(keyframes));
            save_if_due();
          },
          [this](MillMemory memory) {
            if (kept_.keeps()) now_.milling = std::move(memory);
            note();
            save_if_due();
          }};
}

void RunLog::note_replay() {
  note_state();
  save_if_due();
}

void RunLog::end_sweep(const SweepRest& left) {
  now_.sweep_figures = left.figures;
  if (!kept_.keeps()) return;
  now_.sweeping.reset();
  now_.swept = {output_.keyframes(), left.out_of_tool_reach};
  note();
  save_if_due();
}

void RunLog::end_carving() {
  note();
  save_if_due();
}

void RunLog::end_milling(MilledFigures figures, std::vector<Residue> residue) {
  now_.milling.reset();
  now_.milled = std::move(figures);
  now_.residue = std::move(residue);
  note();
  save_if_due();
}

void RunLog::end_plan(std::vector<Residue> residue) {
  now_.residue = std::move(residue);
  note_state();
  save_if_due();
}

void RunLog::go_on() {
  if (now_.file.bytes > 0) earlier_checks_ = now_.checks - own_checks();
}

void RunLog::note() {
  if (!kept_.keeps()) return;
  output_.mark();
  now_.checks = checks();
  note_state();
}

void RunLog::note_state() {
  unsaved_ = kept_.keeps();
}

void RunLog::save() {
  if (!unsaved_) return;
  now_.file = output_.sync();
  if (replay_ != nullptr) now_.replayed = replay_->replayed();
  kept_.save(now_);
  unsaved_ = false;
}

void RunLog::save_if_due() {
  if (kept_.due()) save();
}

void RunLog::save_at_stop() {
  try {
    save();
  } catch (const InputError&) {
  }
}

}  // namespace sculpt
