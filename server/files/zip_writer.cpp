#include "server/files/zip_writer.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <new>
#include <ostream>
#include <stdexcept>

namespace sculpt::server {
namespace {

constexpr int block_bytes = 1 << 16, readable_by_all = 0644;

la_ssize_t write_on(archive*, void* out, const void* bytes, std::size_t size) {
  static_cast<std::ostream*>(out)->write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  return static_cast<la_ssize_t>(size);
}

}  // namespace

struct ZipWriter::Impl {
  Impl() {
    if (zip == nullptr || entry == nullptr) throw std::bad_alloc();
  }
  ~Impl() {
    archive_entry_free(entry);
    archive_write_free(zip);
  }
  void check(la_ssize_t result) const {
    if (result < ARCHIVE_OK) throw std::runtime_error(std::string("cannot pack a .zip: ") + archive_error_string(zip));
  }

  archive* const zip = archive_write_new();
  archive_entry* const entry = archive_entry_new();
};

ZipWriter::ZipWriter(std::ostream& out) : impl_(std::make_unique<Impl>()) {
  impl_->check(archive_write_set_format_zip(impl_->zip));
  impl_->check(archive_write_set_bytes_per_block(impl_->zip, block_bytes));
  impl_->check(archive_write_set_bytes_in_last_block(impl_->zip, 1));  // no padding
  impl_->check(archive_write_open(impl_->zip, &out, nullptr, write_on, nullptr));
}

ZipWriter::~ZipWriter() = default;

// An entry without a time is of the first moment that a .zip can say.
void ZipWriter::add(const std::string& path, std::string_view text) {
  archive_entry_clear(impl_->entry);
  archive_entry_set_pathname(impl_->entry, path.c_str());
  archive_entry_set_filetype(impl_->entry, AE_IFREG);
  archive_entry_set_perm(impl_->entry, readable_by_all);
  archive_entry_set_size(impl_->entry, static_cast<la_int64_t>(text.size()));
  impl_->check(archive_write_header(impl_->zip, impl_->entry));
  impl_->check(archive_write_data(impl_->zip, text.data(), text.size()));
}

void ZipWriter::finish() {
  impl_->check(archive_write_close(impl_->zip));
}

}  // namespace sculpt::server
