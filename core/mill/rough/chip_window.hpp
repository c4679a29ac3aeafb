// Does a cutter take off no more than it may, over any short stretch of its path?
#pragma once

#include <algorithm>

namespace sculpt {

/// Bits of a path, one after the other, are weighed over `length_m` together; those that are shorter than a third of it
/// count as that long.
class ChipWindow {
 public:
  /// `cap_m2`: depth times width of cut that is allowed, volume by length.
  ChipWindow(double cap_m2, double length_m) : cap_m2_(cap_m2), length_m_(length_m) {}

  double length_m() const { return length_m_; }

  /// Of the next bit; false if it would be too much: then it does not count.
  bool take(double volume_m3, double bit_m) {
    if (so_far_m_ >= length_m_) so_far_m_ = taken_m3_ = 0;
    if (taken_m3_ + volume_m3 > cap_m2_ * std::max(so_far_m_ + bit_m, length_m_) ||
        volume_m3 > cap_m2_ * (bit_m + length_m_ / 3))
      return false;
    so_far_m_ += bit_m;
    taken_m3_ += volume_m3;
    return true;
  }

 private:
  double cap_m2_, length_m_;
  double so_far_m_ = 0, taken_m3_ = 0;
};

}  // namespace sculpt
