// The artifacts by name, the forms that each has, and what their files are called.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "proto/messages.hpp"

namespace sculpt::server {

/// Where a form comes from: a run writes it; or it is made when it is first asked for, of the artifact's first form, or
/// of the trajectory by a process that reads the job, which is told more for a program.
enum class Origin { run, first_form, job, program };

struct ArtifactKind {
  struct Format {
    const char* name = nullptr;  ///< nullptr: none
    Origin origin = Origin::run;
  };
  const char* artifact;
  std::array<Format, 3> formats;
  bool grows = false;  ///< its first form, while the job runs
  std::vector<std::string> format_names() const;
};

/// In the order of PROTOCOL.md.
std::span<const ArtifactKind> artifact_kinds();

/// One form of one artifact.
struct ArtifactForm {
  const ArtifactKind* kind;
  std::string format;
  std::string file;  ///< its name in the job's folder
  Origin origin = Origin::run;
  std::string source;  ///< the artifact that it is or is made of

  bool is_own() const { return origin == Origin::run; }
  /// Is it made by a process of its own?
  bool in_child() const { return origin == Origin::job || origin == Origin::program; }
};
/// Of a format that the kind has; without one the first.
ArtifactForm form_of(const ArtifactKind& kind, const std::string& format = {});
/// Throws ProtocolError `params_invalid` for an artifact or a format that there is not; InputError `dialect_unknown`,
/// `name_invalid`.
ArtifactForm find_form(const proto::ArtifactReadParams& wanted);

/// What a download of it is called. Throws as find_form.
std::string download_name(const proto::ArtifactReadParams& wanted);

}  // namespace sculpt::server
