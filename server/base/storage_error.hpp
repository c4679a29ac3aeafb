// What goes wrong where something is to be kept.
#pragma once

#include <stdexcept>

namespace sculpt::server {

/// The disk or the database failed; nothing was acknowledged.
class StorageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The disk has no space left; nothing was acknowledged.
class StorageFull : public StorageError {
 public:
  using StorageError::StorageError;
};

/// The database that several daemons share cannot be reached now; nothing was acknowledged, unless the call says so.
class DatabaseUnavailable : public StorageError {
 public:
  using StorageError::StorageError;
};

}  // namespace sculpt::server
