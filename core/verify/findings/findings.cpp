#include "core/verify/findings/findings.hpp"

#include <utility>

namespace sculpt {
namespace {

constexpr std::size_t listed_findings = 100;

}  // namespace

void PieceFindings::find(std::uint64_t line, std::string sentence) {
  ++collisions;
  if (findings.size() < listed_findings) findings.push_back({line, std::move(sentence)});
}

void PieceFindings::add(PieceFindings&& next) {
  collisions += next.collisions;
  voxels_checked += next.voxels_checked;
  for (Finding& finding : next.findings)
    if (findings.size() < listed_findings) findings.push_back(std::move(finding));
}

}  // namespace sculpt
