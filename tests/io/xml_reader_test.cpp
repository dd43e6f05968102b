#include "io/xml_reader.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "asdf_vk/error.h"
#include "reading.h"

using namespace asdfvk;

namespace {

XmlReader::Read readerOf(std::string_view text) {
  return [text](char* to, size_t size) mutable {
    const size_t count = std::min(size, text.size());
    std::memcpy(to, text.data(), count);
    text.remove_prefix(count);
    return count;
  };
}

/// All tags of a document: "[text]<{namespace}name {namespace}attribute=value" for a start, ">" for an end. The error
/// comes last.
std::string tagsOf(std::string_view text, XmlReader::Prefixes prefixes = XmlReader::Prefixes::Resolved) {
  std::string tags;
  try {
    XmlReader xml(readerOf(text), "d", prefixes);
    for (XmlReader::Event event = xml.next(); event != XmlReader::Event::Finished; event = xml.next()) {
      if (!xml.text().empty()) tags.append("[").append(xml.text()).append("]");
      if (event == XmlReader::Event::End) {
        tags += '>';
        continue;
      }
      const auto nameIn = [](std::string_view space, std::string_view name) {
        return space.empty() ? std::string(name) : "{" + std::string(space) + "}" + std::string(name);
      };
      tags += "<" + nameIn(xml.space(), xml.name());
      for (const XmlReader::Attribute& attribute : xml.attributes())
        tags.append(" ").append(nameIn(attribute.space, attribute.name)).append("=").append(attribute.value);
    }
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Input);
    tags.append("!").append(error.what());
  }
  return tags;
}

}  // namespace

TEST_CASE("the XML reader gives tags, attributes and text") {
  CHECK(tagsOf("<a b='1' c=\"&lt;&#52;&#x34;\"/>") == "<a b=1 c=<44>");
  CHECK(tagsOf("<?xml version='1.0'?><!-- <x> --><a>\n <b/> t <?p <y>?><c><![CDATA[<z>]]></c></a>\n") ==
        "<a<b>[t ]<c[<z>]>>");
  CHECK(tagsOf("<a t='1\n2\t3'/>") == "<a t=1 2 3>");
  CHECK(tagsOf("\xef\xbb\xbf<a/>") == "<a>");
  for (const bool isLittle : {false, true})
    for (const char* const encoding : {"", " encoding='UTF-16'", " encoding='UTF-8'"})
      CHECK(tagsOf(test::utf16("<?xml version='1.0'" + std::string(encoding) + "?><a b='c'/>", !isLittle)) ==
            "<a b=c>");
}

TEST_CASE("the XML reader resolves namespaces, also below the root") {
  CHECK(tagsOf("<a xmlns='n' b='1'><c xmlns:p='m' p:d='2'><p:e/></c><p:f xmlns:p='n'/><g xmlns=''/></a>") ==
        "<{n}a b=1<{n}c {m}d=2<{m}e>><{n}f><g>>");
  CHECK(tagsOf("<a><p:b/></a>") == "<a!d, byte 3: unbound prefix");
  CHECK(tagsOf("<a xmlns='n'><p:b q:c='1'/></a>", XmlReader::Prefixes::PartOfName) == "<a xmlns=n<p:b q:c=1>>");
  XmlReader xml(readerOf("<a xmlns='n' xmlns:p='m'><b xmlns:q='o'/></a>"), "d");
  xml.next();
  xml.next();
  CHECK(xml.namespaceOf("") == "n");
  CHECK(xml.namespaceOf("p") == "m");
  CHECK(xml.namespaceOf("q").empty());
}

TEST_CASE("the XML reader refuses what is not well-formed, after the tags before it") {
  CHECK(tagsOf("") == "!d, byte 0: no element found");
  CHECK(tagsOf("<a><b></a>") == "<a<b!d, byte 8: mismatched tag");
  CHECK(tagsOf("<a><b") == "<a!d, byte 3: truncated: an element has no end; copy or export the file again");
  CHECK(tagsOf("<a><b/>").starts_with("<a<b>!d, byte 7: truncated"));
  CHECK(tagsOf("<a/><b/>") == "<a>!d, byte 4: junk after document element");
  CHECK(tagsOf("<a b='1' b='2'/>") == "!d, byte 9: duplicate attribute");
  for (const char* const text : {"<a 2='1'/>", "<t\xffi/>", "<a b='<'/>", "<a>&x;</a>", "<a>\1</a>", "text"}) {
    CAPTURE(text);
    CHECK(tagsOf(text).find("!d, byte ") != std::string::npos);
  }
  CHECK(tagsOf("<!DOCTYPE a [<!ENTITY e 'x'>]><a>&e;</a>").find("a document type is not allowed") != std::string::npos);
  CHECK(tagsOf("<?xml version='1.0' encoding='KOI8-R'?><a/>").find("unknown encoding") != std::string::npos);
}

TEST_CASE("the XML reader limits depth, attributes, names and tags, and reads texts of any length") {
  std::string open, close;
  for (int i = 0; i < 64; ++i) open += "<a>", close += "</a>";
  CHECK(tagsOf(open + close).find('!') == std::string::npos);
  CHECK(tagsOf("<b>" + open + close + "</b>").find("nested more than 64 levels deep") != std::string::npos);
  std::string attributes;
  for (int i = 0; i < 64; ++i) attributes += " a" + std::to_string(i) + "=''";
  CHECK(tagsOf("<a" + attributes + "/>").find('!') == std::string::npos);
  CHECK(tagsOf("<a b=''" + attributes + "/>") == "!d, byte 0: more than 64 attributes");
  CHECK(tagsOf("<a xmlns='" + std::string(2000, 'n') + "'/>") == "!d, byte 0: a name of more than 1024 bytes");
  const std::string big(2 << 20, ' ');
  CHECK(tagsOf("<a>" + big + "</a>") == "<a>");
  CHECK(tagsOf("<a b='" + std::string(1 << 19, 'x') + "'/>").size() == (1 << 19) + 6);
  for (const std::string& text : {"<a b='" + big + "'/>", "<a><!--" + big + "--></a>", "<a><?p " + big + "?></a>"})
    CHECK(tagsOf(text).find("a tag or comment of more than 1024 KiB") != std::string::npos);
}

TEST_CASE("the XML reader gives the same tags for pieces of any length") {
  std::string text = "<r>", expected = "<r";
  for (int i = 0; i < 20000; ++i) {
    const std::string number = std::to_string(i);
    text += "<v x='" + number + "'/>\n";
    expected += "<v x=" + number + ">";
  }
  CHECK(tagsOf(text + "</r>") == expected + ">");
}
