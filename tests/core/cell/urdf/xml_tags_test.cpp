#include "core/cell/urdf/xml_tags.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sculpt {
namespace {

std::vector<std::string> names(std::string_view xml) {
  std::vector<std::string> names;
  for (auto tag = next_tag(xml, 0); tag; tag = next_tag(xml, tag->end)) {
    EXPECT_EQ(xml.substr(tag->begin, tag->end - tag->begin), tag->text);
    names.push_back((tag->closes() ? "/" : "") + std::string(tag->name()) + (tag->is_empty() ? "/" : ""));
  }
  return names;
}

TEST(XmlTags, ElementsAreFoundAndNothingElse) {
  EXPECT_EQ(names("<?xml version='1.0'?><!DOCTYPE robot><robot\tname='a'><!-- <link name='no'/> --><link name='l'/>"
                  "<![CDATA[<joint>]]><joint>text</joint></robot\n>"),
            (std::vector<std::string>{"robot", "link/", "joint", "/joint", "/robot"}));
  EXPECT_EQ(names("no tag, 3 > 2"), std::vector<std::string>());
}

TEST(XmlTags, AttributesAreWholeWordsWithAnyQuotes) {
  const auto tag = next_tag(R"(<joint rename="x" type = 'fixed' name="a > 'b'" empty=""/>)", 0);
  ASSERT_TRUE(tag);
  EXPECT_TRUE(tag->is_empty());
  EXPECT_EQ(tag->attribute("name"), "a > 'b'");
  EXPECT_EQ(tag->attribute("type"), "fixed");
  EXPECT_EQ(tag->attribute("empty"), "");
  EXPECT_FALSE(tag->attribute("nam"));
  EXPECT_FALSE(next_tag("<a b=c d>", 0)->attribute("b"));
  EXPECT_FALSE(next_tag("<a b= >", 0)->attribute("b"));
}

TEST(XmlTags, ATextThatIsCutAnywhereHasNoTagBeyondItsEnd) {
  const std::string whole =
      "<?xml version='1.0'?><!-- <x/> --><robot name=\"a > b\"><![CDATA[<x/>]]><link name='l'>\n<visual/></link "
      "></robot>";
  const std::vector<std::string> all = names(whole);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::vector<std::string> some = names(std::string_view(whole).substr(0, length));
    ASSERT_LE(some.size(), all.size()) << length;
    ASSERT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << length;
  }
}

}  // namespace
}  // namespace sculpt
