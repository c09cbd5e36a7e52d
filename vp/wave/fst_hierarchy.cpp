#include <limits>
#include <utility>

#include "fst_reader.h"

namespace vp {

namespace {

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
  if (size == 0) return {Kind::real, 1, false};
  if (size == fst::variable_length) return {Kind::text, 1, false};
  return {Kind::bits, size, false};
}

}  // namespace

void FstReader::read_hierarchy() {
  for (const std::uint32_t size : file_.geometry()) nets_.push_back(net_of(size));
  const bool has_geometry = !nets_.empty();
  const std::string bytes = file_.hierarchy();
  fst::Cursor cursor(file_, bytes, 0, "unpacked hierarchy");
  std::vector<Scope> scopes;
  handles_ = 0;
  while (!cursor.at_end()) {
    const std::uint8_t tag = cursor.byte();
    if (tag == fst::scope) {
      const std::uint8_t type = cursor.byte();  // module, task, process …
      if (scopes.size() == deepest_scope)
        cursor.fail("has more than 1000 scopes inside each other");
      const std::string name = clean_name(cursor.text());
      cursor.text();  // its component
      scopes.push_back(
          {(scopes.empty() ? "" : scopes.back().path) + name + (name.empty() ? "" : "."),
           type == fst::sv_array});
      if (scopes.back().path.size() > longest_path) cursor.fail("has a name of more than 64 KiB");
    } else if (tag == fst::upscope) {
      if (scopes.empty()) cursor.fail("leaves a scope that it did not enter");
      scopes.pop_back();
    } else if (tag == fst::attribute) {
      const std::uint8_t type = cursor.byte(), subtype = cursor.byte();
      const std::string_view text = cursor.text();
      const std::uint64_t argument = cursor.varint();
      if (type == fst::attribute_misc && subtype == fst::attribute_enumeration)
        enumerations_.attribute(text, argument);
    } else if (tag <= fst::last_variable_type) {
      read_variable(tag, cursor, scopes.empty() ? Scope{} : scopes.back(), has_geometry);
    } else if (tag != fst::attribute_end) {
      cursor.fail("has an entry of an unknown type");
    }
  }
  for (const WaveVariable& variable : declared_.variables) {
    if (nets_[variable.net].width > widest_signal) {
      cursor.fail("declares a signal of more than 1048576 bits");
    }
  }
}

void FstReader::read_variable(std::uint8_t type, fst::Cursor& cursor, const Scope& scope,
                              bool has_geometry) {
  cursor.byte();  // direction
  WaveDeclared declared;
  WaveVariable& variable = declared.variable;
  const std::string name = clean_name(cursor.text());
  declared.path = scope.path + name;
  path_bytes_ += declared.path.size();
  const std::uint64_t length = cursor.varint(), alias = cursor.varint();
  if (name.empty()) cursor.fail("has a signal without a name");
  if (declared.path.size() > longest_path || path_bytes_ > largest_paths) {
    cursor.fail("has names that are too long");
  }
  if (alias == 0) {
    if (!has_geometry) nets_.push_back(net_of(size_of(type, length)));
    ++handles_;
  }
  const std::uint64_t handle = alias == 0 ? handles_ : alias;
  if (handle > nets_.size()) cursor.fail("has more signals than there are values for");
  variable.net = static_cast<std::uint32_t>(handle - 1);
  Net& net = nets_[variable.net];
  // A state and two strengths for each bit, and blanks between the three.
  if (type == fst::port && net.kind == WaveVariable::Kind::bits && !net.is_port && net.width > 2 &&
      net.width % 3 == 2) {
    net.is_port = true;
    net.width = (net.width - 2) / 3;
  }
  variable.kind = net.kind;
  variable.width = net.width;
  variable.is_event = type == fst::event;
  net.is_event = net.is_event || variable.is_event;
  variable.enumeration = enumerations_.take();
  take_range(declared);
  if (scope.is_array) declared.may_join = false;
  declared_.add(declared);
}

}  // namespace vp
