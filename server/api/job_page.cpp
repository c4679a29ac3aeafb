#include "server/api/job_page.hpp"

namespace sculpt::server {
namespace {

// Of a reply line, for everything around the jobs.
constexpr std::size_t room_for_envelope = 300;

class Page {
 public:
  explicit Page(std::size_t max_line) : left_(max_line - std::min(max_line, room_for_envelope)) {}

  std::size_t size() const { return jobs_.size(); }

  /// False when there is no room; the first job always has some.
  bool add(Json view) {
    const bool room = take_room(view) || jobs_.empty();
    if (room) jobs_.push_back(std::move(view));
    return room;
  }

  void add_damaged(const std::string& job, const std::string& why) {
    Json entry{{"job", job}, {"message", why}};
    if (take_room(entry)) damaged_.push_back(std::move(entry));
  }

  Json result(bool more, std::uint64_t last_event) && {
    Json result{{"jobs", std::move(jobs_)}, {"more", more}, {"last", last_event}};
    if (!damaged_.empty()) result["damaged"] = std::move(damaged_);
    return result;
  }

 private:
  bool take_room(const Json& entry) {
    const std::size_t bytes = proto::write_json(entry).size() + 1;
    const bool fits = bytes <= left_;
    left_ -= std::min(bytes, left_);
    return fits;
  }

  Json jobs_ = Json::array(), damaged_ = Json::array();
  std::size_t left_;
};

// False when the page is full before the end of the jobs.
bool add_views(const ViewSources& sources, const JobPage& found, Page& page) {
  for (const DamagedJob& job : found.damaged) page.add_damaged(job.id, job.why);
  for (const JobRecord& job : found.jobs) {
    Json view;
    try {
      view = job_view(sources, job);
    } catch (const std::exception& error) {
      page.add_damaged(job.id, error.what());
      continue;
    }
    if (!page.add(std::move(view))) return false;
  }
  return true;
}

}  // namespace

Json job_page(const ViewSources& sources, const proto::ListParams& list, std::size_t max_line) {
  // Read first: what happens meanwhile comes as an event behind it.
  const std::uint64_t last_event = sources.store.last_event({});
  JobWindow window{list.after, list.before, list.newest, list.limit};
  Page page(max_line);
  while (true) {
    const JobPage found = sources.store.list(window);
    if (!add_views(sources, found, page)) return std::move(page).result(true, last_event);
    window.limit = list.limit - static_cast<int>(page.size());
    if (window.limit == 0 || !found.more) return std::move(page).result(found.more, last_event);
    (list.newest ? window.before : window.after) = found.jobs.back().id;
  }
}

}  // namespace sculpt::server
