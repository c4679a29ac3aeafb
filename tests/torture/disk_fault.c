// Loaded into the daemon (LD_PRELOAD) it makes the disk under SCULPT_FAULT_ROOT misbehave. Operations are counted from
// 1: writes, truncations, new names, renames, removals and syncs of files and folders there.
//   SCULPT_POWER_CUT=N      before operation N all that was not synced is undone, newest first, and the process is
//   killed SCULPT_TEAR=1           with it: of the newest write that is undone the first half, in whole sectors, stays
//   SCULPT_SYNC_LIES=1      with it: syncs are said to be done and are not, to see that a test finds what is lost by
//   that SCULPT_SYNC_FAILS=N     the N-th sync fails with EIO, once, and what it should have made durable is not
//   SCULPT_DISK_FULL=N,M    the N-th to M-th write fail with ENOSPC
//   SCULPT_COUNT_FILE=PATH  the counts of operations, syncs and writes so far are kept there
// A name is durable once its folder was synced, bytes once their file was. What is mapped into memory is not looked at:
// of SQLite's files that is only the index of the write-ahead log, which it builds anew after a crash. New folders are
// there at once.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum { sector = 512 };

struct change {
  enum { written, resized, created, renamed, removed } kind;
  int file;           // written, resized: a descriptor of our own. It is never closed: that would drop SQLite's locks
  dev_t device;       // of the file whose sync makes the change durable, or of the folder
  ino_t inode;        //
  off_t offset;       // written: where; resized and written: `size` is what the file had before
  off_t size;         //
  size_t length;      // written: how many bytes the call wrote
  size_t old_length;  // and how many of them there were before
  char* old;          //
  char* path;         // created, renamed (to), removed
  char* other;        // renamed (from)
  char* kept;         // renamed, removed: a hard link to what had the name before, or NULL
  struct change* before;
};

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static struct change* newest;
static long operations, syncs, writes, names_kept;
static long cut_at, sync_fails_at, full_from, full_to;
static int tear, sync_lies;
static const char* root;

static ssize_t (*real_write)(int, const void*, size_t);
static ssize_t (*real_pwrite)(int, const void*, size_t, off_t);
static ssize_t (*real_writev)(int, const struct iovec*, int);
static int (*real_fsync)(int);
static int (*real_ftruncate)(int, off_t);
static int (*real_rename)(const char*, const char*);
static int (*real_unlink)(const char*);
static int (*real_open)(const char*, int, ...);
static FILE* (*real_fopen)(const char*, const char*);

static long number(const char* name) {
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

__attribute__((constructor)) static void start(void) {
  real_write = dlsym(RTLD_NEXT, "write");
  real_pwrite = dlsym(RTLD_NEXT, "pwrite");
  real_writev = dlsym(RTLD_NEXT, "writev");
  real_fsync = dlsym(RTLD_NEXT, "fsync");
  real_ftruncate = dlsym(RTLD_NEXT, "ftruncate");
  real_rename = dlsym(RTLD_NEXT, "rename");
  real_unlink = dlsym(RTLD_NEXT, "unlink");
  real_open = dlsym(RTLD_NEXT, "open");
  real_fopen = dlsym(RTLD_NEXT, "fopen");
  root = getenv("SCULPT_FAULT_ROOT");
  cut_at = number("SCULPT_POWER_CUT");
  tear = (int)number("SCULPT_TEAR");
  sync_lies = (int)number("SCULPT_SYNC_LIES");
  sync_fails_at = number("SCULPT_SYNC_FAILS");
  const char* full = getenv("SCULPT_DISK_FULL");
  if (full) sscanf(full, "%ld,%ld", &full_from, &full_to);
}

static int below_root(const char* path) {
  return root && strncmp(path, root, strlen(root)) == 0 && path[strlen(root)] == '/';
}

// A path by which the file of a descriptor can be opened once more, also when it has no name any longer.
static const char* own_path(int file, char path[64]) {
  snprintf(path, 64, "/proc/self/fd/%d", file);
  return path;
}

static int path_of(int file, char* path) {
  char link[64];
  const ssize_t length = readlink(own_path(file, link), path, PATH_MAX - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return 1;
}

// The root itself counts: its sync makes names durable. The index of the write-ahead log does not.
static int is_ours(int file) {
  char path[PATH_MAX];
  if (!root || !path_of(file, path)) return 0;
  const size_t length = strlen(path);
  if (length > 4 && strcmp(path + length - 4, "-shm") == 0) return 0;
  return below_root(path) || strcmp(path, root) == 0;
}

// --- undo

static void copy_back(const struct change* change, size_t from) {
  if (change->old_length > from)
    real_pwrite(change->file, change->old + from, change->old_length - from, change->offset + (off_t)from);
}

static void undo(const struct change* change, int torn) {
  switch (change->kind) {
    case written: {
      const size_t stays = torn ? change->length / 2 / sector * sector : 0;
      copy_back(change, stays);
      off_t size = change->offset + (off_t)stays;
      if (change->size > size) size = change->size;
      real_ftruncate(change->file, size);
      break;
    }
    case resized:
      real_ftruncate(change->file, change->size);
      copy_back(change, 0);
      break;
    case created:
      real_unlink(change->path);
      break;
    case renamed:
      real_rename(change->path, change->other);
      if (change->kept) real_rename(change->kept, change->path);
      break;
    case removed:
      if (change->kept) real_rename(change->kept, change->path);
      break;
  }
}

static void cut_power(void) {
  for (const struct change* change = newest; change; change = change->before) {
    undo(change, tear && change->kind == written);
    if (change->kind == written) tear = 0;
  }
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

static void forget(dev_t device, ino_t inode) {
  for (struct change** at = &newest; *at;) {
    struct change* change = *at;
    if (change->device != device || change->inode != inode) {
      at = &change->before;
      continue;
    }
    *at = change->before;
    if (change->kept) real_unlink(change->kept);
    free(change->old);
    free(change->path);
    free(change->other);
    free(change->kept);
    free(change);
  }
}

// --- remember. All below hold the mutex.

static void count_operation(void) {
  ++operations;
  const char* file = getenv("SCULPT_COUNT_FILE");
  if (file) {
    char text[96];
    const int length = snprintf(text, sizeof text, "%ld %ld %ld          \n", operations, syncs, writes);
    const int out = real_open(file, O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    real_pwrite(out, text, (size_t)length, 0);
    close(out);
  }
  if (cut_at && operations == cut_at) cut_power();
}

static struct change* remember(int kind) {
  struct change* change = calloc(1, sizeof *change);
  change->kind = kind;
  change->before = newest;
  newest = change;
  return change;
}

// The descriptor of our own for this file, opened once.
static int own_descriptor(const char* path, const struct stat* status) {
  static struct {
    dev_t device;
    ino_t inode;
    int file;
  } known[4096];
  static int count;
  for (int i = 0; i < count; ++i)
    if (known[i].device == status->st_dev && known[i].inode == status->st_ino) return known[i].file;
  const int own = real_open(path, O_RDWR | O_CLOEXEC);
  if (own < 0 || count == 4096) abort();
  known[count].device = status->st_dev;
  known[count].inode = status->st_ino;
  known[count].file = own;
  ++count;
  return own;
}

static void remember_bytes(int kind, const char* path, off_t offset, size_t length) {
  struct stat status;
  if (stat(path, &status) != 0) abort();
  struct change* change = remember(kind);
  change->file = own_descriptor(path, &status);
  change->device = status.st_dev;
  change->inode = status.st_ino;
  change->offset = offset;
  change->size = status.st_size;
  change->length = length;
  if (offset < status.st_size) {
    change->old = malloc(length + 1);
    const ssize_t got = pread(change->file, change->old, length, offset);
    change->old_length = got > 0 ? (size_t)got : 0;
  }
}

static void remember_name(struct change* change, const char* path) {
  char folder[PATH_MAX];
  snprintf(folder, sizeof folder, "%s", path);
  char* slash = strrchr(folder, '/');
  if (slash) *slash = 0;
  struct stat status = {0};
  stat(folder, &status);
  change->device = status.st_dev;
  change->inode = status.st_ino;
  change->path = strdup(path);
}

// A second name, outside the daemon's folder, for what `path` names; NULL if that is nothing.
static char* keep(const char* path) {
  char kept[PATH_MAX];
  snprintf(kept, sizeof kept, "%s.kept.%d.%ld", root, (int)getpid(), names_kept++);
  return link(path, kept) == 0 ? strdup(kept) : NULL;
}

// --- the calls

// Nonzero if the write must fail.
static int on_write(int file, off_t offset, size_t length) {
  ++writes;
  count_operation();
  if (full_from && writes >= full_from && writes <= full_to) {
    errno = ENOSPC;
    return 1;
  }
  if (cut_at && length > 0) {
    char path[64];
    remember_bytes(written, own_path(file, path), offset, length);
  }
  return 0;
}

static off_t position(int file) {
  if (fcntl(file, F_GETFL) & O_APPEND) {
    struct stat status;
    fstat(file, &status);
    return status.st_size;
  }
  return lseek(file, 0, SEEK_CUR);
}

ssize_t write(int file, const void* bytes, size_t length) {
  if (!is_ours(file)) return real_write(file, bytes, length);
  pthread_mutex_lock(&mutex);
  const ssize_t done = on_write(file, position(file), length) ? -1 : real_write(file, bytes, length);
  pthread_mutex_unlock(&mutex);
  return done;
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (!is_ours(file)) return real_writev(file, parts, count);
  size_t length = 0;
  for (int i = 0; i < count; ++i) length += parts[i].iov_len;
  pthread_mutex_lock(&mutex);
  const ssize_t done = on_write(file, position(file), length) ? -1 : real_writev(file, parts, count);
  pthread_mutex_unlock(&mutex);
  return done;
}

ssize_t pwrite(int file, const void* bytes, size_t length, off_t offset) {
  if (!is_ours(file)) return real_pwrite(file, bytes, length, offset);
  pthread_mutex_lock(&mutex);
  const ssize_t done = on_write(file, offset, length) ? -1 : real_pwrite(file, bytes, length, offset);
  pthread_mutex_unlock(&mutex);
  return done;
}

ssize_t pwrite64(int file, const void* bytes, size_t length, off64_t offset) {
  return pwrite(file, bytes, length, offset);
}

int ftruncate(int file, off_t size) {
  if (!is_ours(file)) return real_ftruncate(file, size);
  pthread_mutex_lock(&mutex);
  count_operation();
  struct stat status;
  fstat(file, &status);
  char path[64];
  if (cut_at)
    remember_bytes(resized, own_path(file, path), size, size < status.st_size ? (size_t)(status.st_size - size) : 0);
  const int done = real_ftruncate(file, size);
  pthread_mutex_unlock(&mutex);
  return done;
}

int ftruncate64(int file, off64_t size) {
  return ftruncate(file, size);
}

int fsync(int file) {
  if (!is_ours(file)) return real_fsync(file);
  pthread_mutex_lock(&mutex);
  ++syncs;
  count_operation();
  int done = -1;
  if (syncs == sync_fails_at) {
    errno = EIO;
  } else {
    struct stat status;
    fstat(file, &status);
    if (!sync_lies) forget(status.st_dev, status.st_ino);
    done = 0;  // whether the real disk has it does not matter here
  }
  pthread_mutex_unlock(&mutex);
  return done;
}

int fdatasync(int file) {
  return fsync(file);
}

int rename(const char* from, const char* to) {
  if (!below_root(to)) return real_rename(from, to);
  pthread_mutex_lock(&mutex);
  count_operation();
  char* kept = cut_at ? keep(to) : NULL;
  const int done = real_rename(from, to);
  if (cut_at && done == 0) {
    struct change* change = remember(renamed);
    remember_name(change, to);
    change->other = strdup(from);
    change->kept = kept;
  }
  pthread_mutex_unlock(&mutex);
  return done;
}

int unlink(const char* path) {
  if (!below_root(path)) return real_unlink(path);
  pthread_mutex_lock(&mutex);
  count_operation();
  char* kept = cut_at ? keep(path) : NULL;
  const int done = real_unlink(path);
  if (cut_at && done == 0) {
    struct change* change = remember(removed);
    remember_name(change, path);
    change->kept = kept;
  }
  pthread_mutex_unlock(&mutex);
  return done;
}

// Whether this call makes a new name. Remembers what it is about to cut off.
static int before_open(const char* path, int truncates) {
  struct stat status;
  if (stat(path, &status) != 0) return 1;
  if (truncates && cut_at && status.st_size > 0) remember_bytes(resized, path, 0, (size_t)status.st_size);
  return 0;
}

static int is_tracked(const char* path) {
  const size_t length = strlen(path);
  return below_root(path) && !(length > 4 && strcmp(path + length - 4, "-shm") == 0) && strstr(path, "/lock") == NULL;
}

static void after_open(const char* path, int is_new) {
  if (is_new && cut_at) remember_name(remember(created), path);
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (!(flags & (O_CREAT | O_TRUNC)) || !is_tracked(path)) return real_open(path, flags, mode);
  pthread_mutex_lock(&mutex);
  count_operation();
  const int is_new = before_open(path, flags & O_TRUNC);
  const int file = real_open(path, flags, mode);
  if (file >= 0) after_open(path, is_new);
  pthread_mutex_unlock(&mutex);
  return file;
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  if (mode[0] != 'w' || !is_tracked(path)) return real_fopen(path, mode);
  pthread_mutex_lock(&mutex);
  count_operation();
  const int is_new = before_open(path, 1);
  FILE* file = real_fopen(path, mode);
  if (file) after_open(path, is_new);
  pthread_mutex_unlock(&mutex);
  return file;
}

FILE* fopen64(const char* path, const char* mode) {
  return fopen(path, mode);
}
