#include "core/cell/urdf/urdf_guard.hpp"

#include <tinyxml2.h>

#include <string_view>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_urdf_bytes = 2u << 20;

/// urdfdom's parser goes down recursively, so nesting without end would overflow the stack. And urdfdom skips what it
/// does not know, so that of a xacro source parts would be missing. (A URDF that xacro wrote names its namespace still,
/// and may have its source in comments.)
class Guard : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* first) override {
    if (++depth_ > deepest) refuse_nesting();
    for (const auto* attribute = first; attribute != nullptr; attribute = attribute->Next()) refuse_control(*attribute);
    if (std::string_view(element.Name()).starts_with("xacro:"))
      refuse_urdf(
          "the file is a xacro source, not a URDF: write it out with `xacro robot.urdf.xacro > robot.urdf`, and name "
          "that file");
    return true;
  }
  bool VisitExit(const tinyxml2::XMLElement&) override {
    --depth_;
    return true;
  }

  /// They would garble terminals and logs, and two names would look alike.
  static void refuse_control(const tinyxml2::XMLAttribute& attribute) {
    for (const unsigned char c : std::string_view(attribute.Value()))
      if (c < ' ' && c != '\t' && c != '\n' && c != '\r')
        refuse_urdf("line " + std::to_string(attribute.GetLineNum()) + ": '" + attribute.Name() +
                    "' has the control character " + std::to_string(c) + " in it: remove that");
  }

  [[noreturn]] static void refuse_nesting() {
    refuse_urdf("the URDF nests elements more than " + std::to_string(deepest) + " deep: it is no URDF, or damaged");
  }

 private:
  static constexpr int deepest = 100;

  int depth_ = 0;
};

}  // namespace

void refuse_urdf(const std::string& sentence) {
  throw InputError("urdf_invalid", sentence);
}

void check_urdf(const std::string& xml) {
  if (xml.size() > max_urdf_bytes)
    refuse_urdf("the URDF has " + std::to_string(xml.size()) + " bytes, the limit is " +
                std::to_string(max_urdf_bytes));
  if (xml.find("<!DOCTYPE") != std::string::npos)
    refuse_urdf("the URDF has a <!DOCTYPE>, of which no reader of URDF knows anything: remove it");
  tinyxml2::XMLDocument document;
  const tinyxml2::XMLError error = document.Parse(xml.data(), xml.size());
  if (error == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) Guard::refuse_nesting();
  if (error != tinyxml2::XML_SUCCESS)
    refuse_urdf("the URDF is no XML that is whole: line " + std::to_string(document.ErrorLineNum()) + " (" +
                tinyxml2::XMLDocument::ErrorIDToName(error) + ")");
  Guard guard;
  document.Accept(&guard);
}

}  // namespace sculpt
