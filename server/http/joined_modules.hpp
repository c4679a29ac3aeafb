// ES modules as one: a browser asks once where it would ask fifty times, each for a tenth of a picture's time.
#pragma once

#include <functional>
#include <string>

namespace sculpt::server {

/// The text of a module by its name, a path without a leading slash. What it throws reaches the caller.
using ReadModule = std::function<std::string(const std::string& name)>;

/// `entry` and all that it imports, each module in a function of its own and run once, in the order of their imports;
/// the joined module exports what `entry` does. What lies in a folder `vendor/` stays a module for itself, imported by
/// its path from `root` ("/ui/").
///
/// Understood are the forms that a page's own modules use, each at the start of a line: `import {a, b as c} from
/// './x.js';`, also over several lines, and `export` before a function, an async function, a class or a const of one
/// name. Throws std::runtime_error that names the module and the line of another form, and of imports that go round in
/// a circle.
std::string join_modules(const std::string& entry, const std::string& root, const ReadModule& read);

}  // namespace sculpt::server
