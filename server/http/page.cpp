#include "server/http/page.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "core/base/extension.hpp"
#include "core/base/sha256.hpp"
#include "server/files/gzip.hpp"
#include "server/http/joined_modules.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view files_path = "/ui/";

// The modules that a browser begins with; each comes with all that it imports.
constexpr const char* scripts_of_modules[] = {"app.js", "stock/worker.js"};

bool is_script_of_modules(const std::string& name) {
  return std::ranges::find(scripts_of_modules, name) != std::end(scripts_of_modules);
}

// Nothing but the page's own files may run, and it may speak to its own server only. Memory that its workers share
// needs the two cross-origin headers.
constexpr std::pair<const char*, const char*> page_headers[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; worker-src 'self'; connect-src 'self' ws: wss: blob:; img-src 'self' "
     "blob: data:; style-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Embedder-Policy", "require-corp"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
    {"Permissions-Policy", "xr-spatial-tracking=(self)"},
    {"Vary", "Accept-Encoding"}};

const char* media_type_of_file(const std::string& name) {
  const std::string kind = extension_of(name);
  if (kind == "html") return "text/html; charset=utf-8";
  if (kind == "js") return "text/javascript; charset=utf-8";
  if (kind == "css") return "text/css; charset=utf-8";
  return kind == "svg" ? "image/svg+xml" : "text/plain; charset=utf-8";
}

[[noreturn]] void refuse(const std::string& name) {
  throw proto::ProtocolError("not_found", "the page has no file '" + name + "'");
}

// Letters, digits, _ and -, with single dots and slashes between them: what leads out of a folder is no such name.
bool is_name(std::string_view name) {
  bool joint = true;
  for (const char c : name) {
    const bool is_joint = c == '.' || c == '/';
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (is_joint ? joint : !is_plain) return false;
    joint = is_joint;
  }
  return !joint;
}

HttpReply with_headers(const std::string& name, std::string body) {
  HttpReply reply{200, media_type_of_file(name), std::move(body)};
  for (const auto& header : page_headers) reply.headers.emplace_back(header);
  return reply;
}

std::string_view embedded_file(const std::string& name) {
  const auto files = page_files();
  const auto found = std::ranges::find(files, name, &PageFile::name);
  if (found == files.end()) refuse(name);
  return found->gzip;
}

std::string pack(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  write_gzip(in, out);
  return out.str();
}

std::string_view embedded_script(const std::string& name) {
  static const auto packed = [] {
    std::map<std::string, std::string> scripts;
    const auto read = [](const std::string& module) { return read_gzip(embedded_file(module)); };
    for (const char* script : scripts_of_modules)
      scripts[script] = pack(join_modules(script, std::string(files_path), read));
    return scripts;
  }();
  return packed.at(name);
}

HttpReply embedded_reply(const std::string& name, const HttpRequest& request) {
  const std::string_view gzip = is_script_of_modules(name) ? embedded_script(name) : embedded_file(name);
  const bool packed = request.accept_encoding.find("gzip") != std::string::npos;
  const std::string tag = "\"" + sha256_hex(gzip) + (packed ? "-gzip\"" : "\"");
  HttpReply reply = with_headers(name, {});
  reply.headers.emplace_back("ETag", tag);
  if (is_known(request, tag)) {
    reply.status = 304;
    return reply;
  }
  if (packed) reply.headers.emplace_back("Content-Encoding", "gzip");
  reply.body = packed ? std::string(gzip) : read_gzip(gzip);
  return reply;
}

std::string file_of_folder(const fs::path& folder, const std::string& name) {
  std::ifstream in(folder / name, std::ios::binary);
  if (!is_name(name) || !in || !fs::is_regular_file(folder / name)) refuse(name);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

HttpReply folder_reply(const fs::path& folder, const std::string& name) {
  const auto read = [&](const std::string& file) { return file_of_folder(folder, file); };
  return with_headers(name,
                      is_script_of_modules(name) ? join_modules(name, std::string(files_path), read) : read(name));
}

}  // namespace

bool is_page(std::string_view target) {
  return target == "/" || target.starts_with(files_path);
}

HttpReply page_reply(const fs::path& folder, const HttpRequest& request) {
  const std::string name = request.target == "/" ? "index.html" : request.target.substr(files_path.size());
  return folder.empty() ? embedded_reply(name, request) : folder_reply(folder, name);
}

}  // namespace sculpt::server
