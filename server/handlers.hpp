// One handler per method of proto/PROTOCOL.md. All run on the I/O thread; what needs time goes to a task queue.
#pragma once

#include "server/dispatch.hpp"

namespace sculpt {

// server_handlers.cpp
void on_hello(Services& services, Call call);
void on_ping(Services& services, Call call);
void on_server_info(Services& services, Call call);
void on_server_schema(Services& services, Call call);

// blob_handlers.cpp
void on_blob_has(Services& services, Call call);
void on_blob_put(Services& services, Call call);

// submit_handler.cpp
void on_submit(Services& services, Call call);

// job_handlers.cpp
void on_get(Services& services, Call call);
void on_list(Services& services, Call call);
void on_wait(Services& services, Call call);
void on_report(Services& services, Call call);
void on_verify(Services& services, Call call);

// control_handlers.cpp
void on_cancel(Services& services, Call call);
void on_pause(Services& services, Call call);
void on_resume(Services& services, Call call);
void on_retry(Services& services, Call call);
void on_queue_pause(Services& services, Call call);
void on_queue_resume(Services& services, Call call);

// event_handlers.cpp
void on_subscribe(Services& services, Call call);
void on_unsubscribe(Services& services, Call call);

// artifact_handlers.cpp
void on_artifact_list(Services& services, Call call);
void on_artifact_pin(Services& services, Call call);
void on_artifact_read(Services& services, Call call);

}  // namespace sculpt
