#include <limits>
#include <optional>

#include "fst_reader.h"

namespace vp {

namespace {

constexpr std::size_t deepest = 1000;
constexpr std::size_t longest_path = 1 << 16;
constexpr std::uint64_t largest_paths = std::uint64_t{1} << 30;

/// As a VCD would have it: the first word; the range follows a blank. A file may say anything.
std::string word(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == ' ' && !text.empty()) break;
    if (c != ' ') text += (c > 0 && c < ' ') || c == '\x7f' ? '?' : c;
  }
  return text;
}

bool is_real(std::uint8_t type) {
  return type == fst::real || type == fst::real_parameter || type == fst::realtime ||
         type == fst::shortreal;
}

/// What the geometry says of a variable of `type` and `length`.
std::uint32_t size_of(std::uint8_t type, std::uint64_t length) {
  if (is_real(type)) return 0;
  if (type == fst::text || length == 0) return fst::variable_length;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(length, std::numeric_limits<std::uint32_t>::max() - 1));
}

FstReader::Net net_of(std::uint32_t size) {
  using Kind = WaveVariable::Kind;
  if (size == 0) return {Kind::real, 1};
  if (size == fst::variable_length) return {Kind::text, 1};
  return {Kind::bits, size};
}

}  // namespace

void FstReader::read_hierarchy() {
  constexpr std::uint32_t widest = 1 << 20;
  for (const std::uint32_t size : file_.geometry()) nets_.push_back(net_of(size));
  const bool has_geometry = !nets_.empty();
  const std::string bytes = file_.hierarchy();
  fst::Cursor cursor(file_, bytes, 0, "unpacked hierarchy");
  std::vector<std::string> scopes;
  handles_ = 0;
  while (!cursor.at_end()) {
    const std::uint8_t tag = cursor.byte();
    if (tag == fst::scope) {
      cursor.byte();  // module, task, process …
      if (scopes.size() == deepest) cursor.fail("has more than 1000 scopes inside each other");
      const std::string name = word(cursor.text());
      cursor.text();  // its component
      scopes.push_back((scopes.empty() ? "" : scopes.back()) + name + (name.empty() ? "" : "."));
      if (scopes.back().size() > longest_path) cursor.fail("has a name of more than 64 KiB");
    } else if (tag == fst::upscope) {
      if (scopes.empty()) cursor.fail("leaves a scope that it did not enter");
      scopes.pop_back();
    } else if (tag == fst::attribute) {
      cursor.byte();
      cursor.byte();
      cursor.text();
      cursor.varint();
    } else if (tag <= fst::last_variable_type) {
      read_variable(tag, cursor, scopes.empty() ? std::string() : scopes.back(), has_geometry);
    } else if (tag != fst::attribute_end) {
      cursor.fail("has an entry of an unknown type");
    }
  }
  for (const WaveVariable& variable : variables_) {
    if (nets_[variable.net].width > widest) {
      cursor.fail("declares a signal of more than 1048576 bits");
    }
  }
}

void FstReader::read_variable(std::uint8_t type, fst::Cursor& cursor, const std::string& scope,
                              bool has_geometry) {
  cursor.byte();  // direction
  WaveVariable variable;
  const std::string name = word(cursor.text());
  variable.path = scope + name;
  path_bytes_ += variable.path.size();
  const std::uint64_t length = cursor.varint(), alias = cursor.varint();
  if (name.empty()) cursor.fail("has a signal without a name");
  if (variable.path.size() > longest_path || path_bytes_ > largest_paths) {
    cursor.fail("has names that are too long");
  }
  if (type == fst::port) cursor.fail("has ports of an extended VCD, which are not supported");
  if (alias == 0) {
    if (!has_geometry) nets_.push_back(net_of(size_of(type, length)));
    ++handles_;
  }
  const std::uint64_t handle = alias == 0 ? handles_ : alias;
  if (handle > nets_.size()) cursor.fail("has more signals than there are values for");
  variable.net = static_cast<std::uint32_t>(handle - 1);
  variable.kind = nets_[variable.net].kind;
  variable.width = nets_[variable.net].width;
  variables_.push_back(std::move(variable));
}

}  // namespace vp
