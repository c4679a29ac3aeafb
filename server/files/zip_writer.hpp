// Texts -> a .zip of them. No clock and no folder is asked: the same texts always give the same bytes.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

namespace sculpt::server {

/// Not copied, nor shared between threads. Holds one file's packed bytes at a time. Errors of the stream are left to
/// the caller.
class ZipWriter {
 public:
  /// `out` must outlive it.
  explicit ZipWriter(std::ostream& out);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// `path`: ASCII, with / between folders. Throws std::runtime_error.
  void add(const std::string& path, std::string_view text);
  /// Call last: without it there is no whole .zip. Throws the same.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt::server
