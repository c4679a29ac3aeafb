#include "proto/motion/motion_spec.hpp"

namespace sculpt::proto {
namespace {

constexpr double huge_speed = 1e6;  // m/s: beyond this a value is surely a mistake

}  // namespace

// Whether they make sense is the planner's to say (`feed_invalid`).
MotionSpec read_motion(Fields fields) {
  MotionSpec spec;
  if (fields.has("feed_m_s")) spec.feed_m_s = fields.number("feed_m_s", -huge_speed, huge_speed);
  if (fields.has("rapid_m_s")) spec.rapid_m_s = fields.number("rapid_m_s", -huge_speed, huge_speed);
  if (fields.has("keep_feed")) spec.keep_feed = fields.number("keep_feed", -huge_speed, huge_speed);
  fields.done();
  return spec;
}

Json to_json(const MotionSpec& spec) {
  Json json = Json::object();
  if (spec.feed_m_s) json["feed_m_s"] = *spec.feed_m_s;
  if (spec.rapid_m_s != MotionSpec{}.rapid_m_s) json["rapid_m_s"] = spec.rapid_m_s;
  if (spec.keep_feed) json["keep_feed"] = *spec.keep_feed;
  return json;
}

}  // namespace sculpt::proto
