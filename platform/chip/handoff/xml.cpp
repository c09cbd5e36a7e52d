#include <chip/handoff/xml.h>

#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace platform::handoff {

XmlDocument::XmlDocument(std::string text, std::string origin)
    : text_(std::move(text)), origin_(std::move(origin)) {
  const pugi::xml_parse_result result = document_.load_buffer(
      text_.data(), text_.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_auto);
  if (!result) {
    throw vp::InputError(at_offset(result.offset) + ": this is not whole XML (" +
                         result.description() + "): export it again");
  }
  for (const pugi::xml_node& node : document_.children()) {
    if (node.type() == pugi::node_doctype)
      fail(node, "a document type declaration, which Vivado does not write: entities are refused");
  }
}

pugi::xml_node XmlDocument::root(const std::string& name) const {
  pugi::xml_node found;
  for (const pugi::xml_node& node : document_.children()) {
    if (node.type() != pugi::node_element) continue;
    if (node.name() != name) {
      fail(node, "the file begins with <" + vp::excerpt(vp::visible(node.name())) +
                     ">, not with <" + name + ">");
    }
    if (found) fail(node, "a second <" + name + "> in one file: keep one of them");
    found = node;
  }
  if (!found) throw vp::InputError(origin_ + ": no <" + name + "> in it");
  return found;
}

std::string XmlDocument::where(const pugi::xml_node& node) const {
  return at_offset(node.offset_debug());
}

void XmlDocument::fail(const pugi::xml_node& node, const std::string& problem) const {
  throw vp::InputError(where(node) + ": " + problem);
}

std::string XmlDocument::at_offset(std::ptrdiff_t offset) const {
  if (offset < 0) return origin_;
  const auto end =
      text_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(text_.size()));
  return origin_ + ":" + std::to_string(1 + std::count(text_.begin(), end, '\n'));
}

std::string_view attribute(const pugi::xml_node& node, const char* name) {
  return node.attribute(name).value();
}

}  // namespace platform::handoff
