#pragma once

#include <string>
#include <string_view>

#include <pugixml.hpp>

namespace platform::handoff {

/// An XML document from outside. Entities are never expanded: a document type declaration, which
/// could define some, is refused.
class XmlDocument {
 public:
  /// `origin` names it in messages. Throws vp::InputError "origin:line: …" for what is not XML.
  XmlDocument(std::string text, std::string origin);

  /// The element at the top. Throws vp::InputError if there are several, or it has another name.
  pugi::xml_node root(const std::string& name) const;
  /// File and line of an element.
  std::string where(const pugi::xml_node& node) const;
  /// Throws vp::InputError "origin:line: problem".
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& problem) const;

 private:
  std::string at_offset(std::ptrdiff_t offset) const;

  std::string text_;
  std::string origin_;
  pugi::xml_document document_;
};

/// The value of an attribute; "" if it is missing.
std::string_view attribute(const pugi::xml_node& node, const char* name);

}  // namespace platform::handoff
