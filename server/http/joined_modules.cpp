#include "server/http/joined_modules.hpp"

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace sculpt::server {
namespace {

constexpr std::string_view vendored = "vendor/";

struct Import {
  std::string names;  ///< as between the braces
  std::string module;
};

/// One module, taken apart.
struct Module {
  std::vector<Import> imports;
  std::vector<std::string> exports;
  std::string body;  ///< without the words import and export
};

[[noreturn]] void refuse(const std::string& name, const std::string& line) {
  throw std::runtime_error("the module '" + name + "' cannot be joined with others: its line '" + line +
                           "' is of no form that is understood");
}

/// The name of the module that another one calls this.
std::string resolve(const std::string& name, const std::string& path) {
  return (std::filesystem::path(name).parent_path() / path).lexically_normal().generic_string();
}

Import read_import(const std::string& name, const std::string& statement) {
  static const std::regex form(R"(import\s*\{([^{}]*)\}\s*from\s*'(\.[^']*)';)");
  std::smatch parts;
  if (!std::regex_match(statement, parts, form)) refuse(name, statement);
  return {parts[1], resolve(name, parts[2])};
}

/// Modules that are imported when they are needed are found from anywhere.
std::string with_late_imports(const std::string& name, const std::string& root, std::string line) {
  static const std::regex form(R"(import\('(\.[^']*)'\))");
  std::smatch parts;
  std::string before;
  while (std::regex_search(line, parts, form)) {
    before += parts.prefix().str() + "import('" + root + resolve(name, parts[1]) + "')";
    line = parts.suffix();
  }
  return before + line;
}

Module take_apart(const std::string& name, const std::string& root, const std::string& text) {
  static const std::regex form(R"(export ((?:async )?function|class|const) (\w+)\b.*)");
  Module module;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("import")) {
      for (std::string more; !line.ends_with(';') && std::getline(lines, more);) line += ' ' + more;
      module.imports.push_back(read_import(name, line));
      continue;
    }
    if (line.starts_with("export")) {
      std::smatch parts;
      if (!std::regex_match(line, parts, form)) refuse(name, line);
      module.exports.push_back(parts[2]);
      line.erase(0, std::string_view("export ").size());
    }
    module.body += with_late_imports(name, root, line) + '\n';
  }
  return module;
}

std::string in_braces(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return "{" + list + "}";
}

/// `a, b as c` as a pattern that takes an object apart: `{a, b: c}`.
std::string as_pattern(const std::string& names) {
  static const std::regex as(R"(\s+as\s+)");
  return "{" + std::regex_replace(names, as, ": ") + "}";
}

class Joiner {
 public:
  Joiner(const std::string& root, const ReadModule& read) : root_(root), read_(read) {}

  std::string join(const std::string& entry) {
    add(entry);
    return imports_ + "const modules = {};\n" + bodies_ + "export const " + in_braces(exports_.at(entry)) +
           " = modules['" + entry + "'];\n";
  }

 private:
  void add(const std::string& name) {
    const auto [known, is_new] = is_done_.try_emplace(name, false);
    if (!is_new && !known->second) throw std::runtime_error("the module '" + name + "' imports itself in the end");
    if (!is_new) return;
    const Module module = take_apart(name, root_, read_(name));
    std::string inside;
    for (const Import& import : module.imports) {
      inside += "const " + as_pattern(import.names) + " = " + object_of(import.module) + ";\n";
    }
    bodies_ += "modules['" + name + "'] = (() => {\n" + inside + module.body + "return " + in_braces(module.exports) +
               ";\n})();\n";
    exports_[name] = module.exports;
    is_done_[name] = true;
  }

  std::string object_of(const std::string& module) {
    if (!module.starts_with(vendored)) {
      add(module);
      return "modules['" + module + "']";
    }
    const auto [known, is_new] = outside_.try_emplace(module, "outside_" + std::to_string(outside_.size()));
    if (is_new) imports_ += "import * as " + known->second + " from '" + root_ + module + "';\n";
    return known->second;
  }

  const std::string& root_;
  const ReadModule& read_;
  std::map<std::string, bool> is_done_;
  std::map<std::string, std::vector<std::string>> exports_;
  std::map<std::string, std::string> outside_;  // what it is called in the joined module, by module
  std::string imports_, bodies_;
};

}  // namespace

std::string join_modules(const std::string& entry, const std::string& root, const ReadModule& read) {
  return Joiner(root, read).join(entry);
}

}  // namespace sculpt::server
