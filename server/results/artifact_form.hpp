// The artifacts by name, the forms that each has, and what their files are called.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "proto/messages.hpp"

namespace sculpt::server {

struct ArtifactKind {
  const char* artifact;
  std::array<const char*, 3> formats;  ///< the first is the one that the others are made of; nullptr: none
  bool grows = false;                  ///< its first form, while the job runs
  const char* made_of = nullptr;       ///< the artifact that even the first form is made of when it is asked for
  std::vector<std::string> format_names() const;
};

/// In the order of PROTOCOL.md.
std::span<const ArtifactKind> artifact_kinds();

/// One form of one artifact.
struct ArtifactForm {
  const ArtifactKind* kind;
  std::string format;
  std::string file;    ///< its name in the job's folder
  bool is_own = true;  ///< a run writes it; else it is made from `source`
  std::string source;  ///< the artifact that it is or is made of
};
/// Of a name that artifact_kinds() has; without a format the first one.
ArtifactForm form_of(const ArtifactKind& kind, const std::string& format = {});
/// Throws ProtocolError `params_invalid` for an artifact or a format that there is not; InputError `dialect_unknown`,
/// `name_invalid`.
ArtifactForm find_form(const proto::ArtifactReadParams& wanted);

/// What a download of it is called. Throws as find_form.
std::string download_name(const proto::ArtifactReadParams& wanted);

}  // namespace sculpt::server
