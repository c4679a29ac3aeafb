// Robots and cells that several tests use.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/random.hpp"
#include "core/cell/cell.hpp"

namespace sculpt {

/// Parses a URDF that refers to no files.
Robot parse_plain(const std::string& xml);

Cell shipped_cell(const std::string& name);

/// A robot and the two links between which a test wants the chain; owns what the chain refers to.
struct SampleChain {
  std::string title;
  Robot robot;
  std::string stock, tool;
  double stickout_m = 0;

  Chain chain() const;
};

/// An arm with three joints in skew directions on a rail; the stock stands in the room.
SampleChain arm_on_rail();
/// A tilting table on the stock side; on the tool side a slide, its mimic, a mimic of the mimic and fixed joints
/// between them.
SampleChain mimic_machine();
SampleChain shipped_chain(const Cell& cell);

/// Each coordinate between its limits, `margin` (share of its range) away from both.
Configuration random_configuration(const Chain& chain, Random& random, double margin = 0);

/// A folder of its own under the system's folder for temporary files, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

}  // namespace sculpt
