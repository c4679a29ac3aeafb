// Which system calls a thread may make, by seccomp.
#pragma once

namespace sculpt::server {

/// For the calling thread and those that it starts, for good: what computing, threads, memory, time and open files
/// need. No sockets, programs, processes, signals to others, tracing, or changes to the system: those fail with ENOSYS,
/// which a newer C library takes as a call that this kernel does not have yet. Gives 0, or the errno with which the
/// kernel refused. Needs PR_SET_NO_NEW_PRIVS.
int filter_syscalls();

}  // namespace sculpt::server
