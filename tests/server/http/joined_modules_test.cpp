#include "server/http/joined_modules.hpp"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace sculpt::server {
namespace {

using Files = std::map<std::string, std::string>;

std::string join(const Files& files, const std::string& entry = "app.js") {
  return join_modules(entry, "/ui/", [&](const std::string& name) {
    const auto found = files.find(name);
    if (found == files.end()) throw std::out_of_range("no file " + name);
    return found->second;
  });
}

std::string why_not(const Files& files) {
  try {
    join(files);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "joined";
}

TEST(JoinedModules, EachStandsOnceBehindWhatItImports) {
  const Files files{
      {"app.js",
       "import {b} from './parts/b.js';\nimport {\n  c as d,\n  E,\n} from './c.js';\nexport const app = b + d;\n"},
      {"parts/b.js", "import {c} from '../c.js';\nexport function b() { return c; }\nconst hidden = 1;\n"},
      {"c.js", "export const c = 2;\nexport class E {}\n"}};
  EXPECT_EQ(join(files), R"(const modules = {};
modules['c.js'] = (() => {
const c = 2;
class E {}
return {c, E};
})();
modules['parts/b.js'] = (() => {
const {c} = modules['c.js'];
function b() { return c; }
const hidden = 1;
return {b};
})();
modules['app.js'] = (() => {
const {b} = modules['parts/b.js'];
const {   c: d,   E, } = modules['c.js'];
const app = b + d;
return {app};
})();
export const {app} = modules['app.js'];
)");
}

TEST(JoinedModules, WhatIsVendoredStaysAModule) {
  const Files files{
      {"app.js", "import {x} from './a/b.js';\nimport {y} from './vendor/big.js';\nexport async function app() {}\n"},
      {"a/b.js", "import {y as x} from '../vendor/big.js';\n"}};
  const std::string joined = join(files);
  EXPECT_TRUE(joined.starts_with("import * as outside_0 from '/ui/vendor/big.js';\nconst modules")) << joined;
  EXPECT_EQ(joined.find("import", 1), std::string::npos) << joined;
  EXPECT_NE(joined.find("const {y: x} = outside_0;"), std::string::npos) << joined;
}

TEST(JoinedModules, WhatIsImportedLaterIsFoundFromAnywhere) {
  const Files files{{"app.js", "import {b} from './parts/b.js';\nexport const app = () => import('./late.js');\n"},
                    {"parts/b.js", "export const b = () => [import('../late.js'), import('./later.js')];\n"}};
  const std::string joined = join(files);
  EXPECT_NE(joined.find("[import('/ui/late.js'), import('/ui/parts/later.js')]"), std::string::npos) << joined;
  EXPECT_NE(joined.find("app = () => import('/ui/late.js')"), std::string::npos) << joined;
}

TEST(JoinedModules, OtherFormsAreRefusedByNameAndLine) {
  for (const char* line : {"import x from './b.js';", "import * as x from './b.js';", "import './b.js';",
                           "import {x} from 'three';", "import {x} from \"./b.js\";", "export default 1;",
                           "export {x};", "export let x = 1;", "export * from './b.js';", "import {x} from './b.js'"}) {
    const std::string why = why_not({{"app.js", "import {b} from './b.js';\n"}, {"b.js", std::string("1;\n") + line}});
    EXPECT_NE(why.find("'b.js'"), std::string::npos) << why;
    EXPECT_NE(why.find(line), std::string::npos) << why;
  }
}

TEST(JoinedModules, ACircleIsRefused) {
  EXPECT_NE(why_not({{"app.js", "import {b} from './b.js';\n"}, {"b.js", "import {app} from './app.js';\n"}})
                .find("'app.js'"),
            std::string::npos);
}

TEST(JoinedModules, WhatCannotBeReadIsTold) {
  EXPECT_THROW(join({{"app.js", "import {b} from './../../b.js';\n"}}), std::out_of_range);
}

}  // namespace
}  // namespace sculpt::server
