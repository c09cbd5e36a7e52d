#include <vp/error.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "vcd_reader.h"

// The declarations of a VCD.

namespace vp {

namespace {

constexpr std::uint64_t fs_per_ns = 1'000'000;
constexpr const char* header = "the header";

/// A time such as "10ns", "0.1ps" or "5 us" in femtoseconds; 0 if it is not one.
std::uint64_t femtoseconds(std::string text) {
  struct Scale {
    const char* unit;
    std::uint64_t fs;
  };
  static constexpr Scale scales[] = {{"fs", 1},
                                     {"ps", 1000},
                                     {"ns", fs_per_ns},
                                     {"us", 1'000'000'000},
                                     {"ms", 1'000'000'000'000},
                                     {"s", 1'000'000'000'000'000}};
  constexpr std::uint64_t most_factor = 1'000'000;
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  std::uint64_t whole = 0;
  const char* const end = text.data() + text.size();
  auto parsed = std::from_chars(text.data(), end, whole);
  const char* at = parsed.ptr;
  if (parsed.ec != std::errc() && (at == end || *at != '.')) return 0;
  std::uint64_t parts = 0, per = 1;
  if (at != end && *at == '.') {
    for (++at; at != end && *at >= '0' && *at <= '9'; ++at) {
      if (per == most_factor) return 0;
      parts = parts * 10 + static_cast<std::uint64_t>(*at - '0');
      per *= 10;
    }
  }
  const std::string_view unit(at, static_cast<std::size_t>(end - at));
  for (const Scale& scale : scales) {
    if (unit != scale.unit || whole > most_factor) continue;
    const auto fs = static_cast<unsigned __int128>(whole * per + parts) * scale.fs;
    if (fs % per != 0 || fs / per > std::numeric_limits<std::uint64_t>::max()) return 0;
    return static_cast<std::uint64_t>(fs / per);
  }
  return 0;
}

/// "8", or "[7:0]" and "[3]" of a port. None: it is no size.
bool read_size(std::string_view text, std::uint64_t& size) {
  const char* const end = text.data() + text.size();
  if (text.front() != '[') {
    const auto parsed = std::from_chars(text.data(), end, size);
    return parsed.ec == std::errc() && parsed.ptr == end;
  }
  std::int32_t left = 0, right = 0;
  auto parsed = std::from_chars(text.data() + 1, end, left);
  right = left;
  if (parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == ':')
    parsed = std::from_chars(parsed.ptr + 1, end, right);
  size = static_cast<std::uint64_t>(std::abs(std::int64_t{left} - right)) + 1;
  return parsed.ec == std::errc() && parsed.ptr + 1 == end && *parsed.ptr == ']';
}

WaveVariable::Kind kind_of(std::string_view type) {
  if (type == "real" || type == "realtime" || type == "shortreal" || type == "real_parameter")
    return WaveVariable::Kind::real;
  return type == "string" ? WaveVariable::Kind::text : WaveVariable::Kind::bits;
}

}  // namespace

void VcdReader::read_header() {
  // Of UTF-8; its three bytes count as no white space.
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (bool first = true;; first = false) {
    std::string_view word = next(header);
    if (first && word.substr(0, 3) == byte_order_mark) {
      word.remove_prefix(3);
      if (word.empty()) word = next(header);
    }
    if (declared_.size() != 0 && begins_values(word)) {
      window_.cursor = word.data();
      note("has no $enddefinitions: the header ends with the first value");
      break;
    }
    if (word == "$enddefinitions") {
      skip_to_end(header);
      break;
    }
    if (!read_header_word(word)) {
      fail((first ? "begins with " : "unexpected ") + shown(word) +
           (first ? ": this is no VCD" : " in the header"));
    }
  }
  if (declared_.size() == 0) fail("the header declares no signal");
  if (timescale_fs_ == 0) {
    timescale_fs_ = options_.timescale_fs != 0 ? options_.timescale_fs : fs_per_ns;
    if (options_.timescale_fs == 0)
      notes_.add("has no $timescale: its times are taken as ns (--timescale sets another unit)", 0);
  }
  finish_declarations();
}

/// The word begins the values although the header was not ended.
bool VcdReader::begins_values(std::string_view word) const {
  if (word == "$dumpvars" || word == "$dumpall" || word == "$dumpports") return true;
  if (word.front() == '#') return true;
  constexpr std::string_view scalars = "01xXzZuUwWlLhH-", others = "bBrRsSp";
  if (scalars.find(word.front()) != std::string_view::npos)
    return word.size() > 1 && net_of(word.substr(1)) != 0;
  return word.size() > 1 && others.find(word.front()) != std::string_view::npos;
}

/// False: it is not one that a header may have.
bool VcdReader::read_header_word(std::string_view word) {
  if (word == "$timescale") {
    read_timescale();
  } else if (word == "$scope") {
    read_scope();
  } else if (word == "$upscope") {
    leave_scope();
  } else if (word == "$var") {
    read_variable();
  } else if (word == "$attrbegin") {
    read_attribute();
  } else if (word.front() == '$') {
    if (word != "$end") skip_to_end(header);  // $date, $version, $comment and what others add
  } else {
    return false;
  }
  return true;
}

void VcdReader::read_timescale() {
  std::string text;
  for (std::string_view word = next("$timescale"); word != "$end"; word = next("$timescale")) {
    if (text.size() < 64) text += word;
  }
  timescale_fs_ = femtoseconds(text);
  if (timescale_fs_ == 0) {
    fail("the timescale " + shown(text) +
         " is not a whole number of fs: it must be a number of fs, ps, ns, us, ms or s");
  }
}

void VcdReader::read_scope() {
  const std::string type(next("$scope"));  // module, task, begin …
  std::string name;
  if (type != "$end") {
    for (std::string_view word = next("$scope"); word != "$end"; word = next("$scope")) {
      name += (name.empty() ? "" : " ") + std::string(word);
      if (name.size() > longest_path) fail("the name of a scope has more than 64 KiB");
    }
  }
  if (scopes_.size() == deepest_scope) fail("more than 1000 scopes inside each other");
  // A scope without a name adds no level.
  Scope scope{scopes_.empty() ? "" : scopes_.back().path,
              type == "sv_array" || type == "vhdl_array"};
  if (!name.empty()) scope.path += clean_name(name) + ".";
  if (scope.path.size() > longest_path) fail("the name of a scope has more than 64 KiB");
  scopes_.push_back(std::move(scope));
}

void VcdReader::leave_scope() {
  if (scopes_.empty()) fail("$upscope without $scope");
  scopes_.pop_back();
  skip_to_end("$upscope");
}

void VcdReader::read_attribute() {
  std::string text;
  const std::string kind(next("$attrbegin"));
  const std::string subtype(kind == "$end" ? "" : next("$attrbegin"));
  if (kind == "$end" || subtype == "$end") return;
  constexpr std::size_t longest = 1 << 20;
  for (std::string_view word = next("$attrbegin"); word != "$end"; word = next("$attrbegin")) {
    text += (text.empty() ? "" : " ") + std::string(word);
    if (text.size() > longest) fail("an attribute of more than 1 MiB");
  }
  if (kind != "misc" || (subtype != "07" && subtype != "7")) return;
  const std::size_t last = text.rfind(' ');
  if (last == std::string::npos) return;
  std::uint64_t handle = 0;
  const auto parsed =
      std::from_chars(text.data() + last + 1, text.data() + text.size(), handle, 16);
  if (parsed.ec == std::errc()) enumerations_.attribute(text.substr(0, last), handle);
}

void VcdReader::read_variable() {
  const std::string type(next("$var"));
  const std::string size(type == "$end" ? type : next("$var"));
  const std::string code(size == "$end" ? size : next("$var"));
  std::string name;
  if (code != "$end") {
    for (std::string_view word = next("$var"); word != "$end"; word = next("$var")) {
      name += (name.empty() ? "" : " ") + std::string(word);
      if (name.size() > longest_path) fail("a name of more than 64 KiB");
    }
  }
  if (name.empty()) {
    if (!options_.lenient) fail("$var needs a type, a size, an identifier and a name");
    note("a $var without identifier or name is left out");
    return;
  }
  WaveDeclared declared;
  WaveVariable& variable = declared.variable;
  declared.line = window_.line(at_);
  variable.kind = kind_of(type);
  variable.is_event = type == "event";
  const bool is_bits = variable.kind == WaveVariable::Kind::bits;
  std::uint64_t width = 0;
  if (!read_size(size, width) || width > widest_signal)
    fail("the size " + shown(size) + " of signal " + shown(name) + " is not 0 to 1048576");
  variable.width = !is_bits || variable.is_event ? 1 : static_cast<unsigned>(width);
  if (!scopes_.empty()) declared.path = scopes_.back().path;
  declared.path += clean_name(name);
  path_bytes_ += declared.path.size();
  if (declared.path.size() > longest_path || path_bytes_ > largest_paths)
    fail("names of more than 64 KiB, or of 1 GiB together");
  variable.net = declare_net(code, variable.kind, variable.width, variable.is_event);
  variable.enumeration = enumerations_.take();
  take_range(declared);
  if (!scopes_.empty() && scopes_.back().is_array) declared.may_join = false;
  declared_.add(declared);
}

std::uint32_t VcdReader::declare_net(std::string_view code, WaveVariable::Kind kind, unsigned width,
                                     bool is_event) {
  for (const char c : code) {
    if (c < '!' || c > '~')
      fail("the identifier " + shown(code) + " has characters that are not printable");
  }
  std::uint32_t* place = nullptr;
  constexpr std::size_t short_code = 3;
  if (code.size() <= short_code) {
    std::size_t index = 0;
    for (const char c : code) index = index * 94 + static_cast<std::size_t>(c - '!') + 1;
    if (index >= by_short_code_.size()) by_short_code_.resize(index + 1);
    place = &by_short_code_[index];
  } else {
    place = &by_long_code_[code];
  }
  if (*place == 0) {
    Net net{};
    net.width = width & 0xffffff;
    net.kind = kind;
    net.is_event = is_event;
    nets_.push_back(net);
    return (*place = static_cast<std::uint32_t>(nets_.size())) - 1;
  }
  Net& net = nets_[*place - 1];
  if (net.kind != kind || net.width != width || net.is_event != is_event) {
    note(
        "an identifier is declared with several types or sizes: it has the first type and the "
        "largest size");
    if (width > net.width) net.width = width & 0xffffff;
    retyped_ = true;
  }
  return *place - 1;
}

/// Names of one net have one type and size.
void VcdReader::finish_declarations() {
  scopes_.clear();
  if (!retyped_) return;
  std::vector<WaveVariable>& variables = declared_.variables;
  const auto changes = [&](const WaveDeclarations::Range& range) {
    const WaveVariable& variable = variables[range.place];
    const Net& net = nets_[variable.net];
    return net.kind != variable.kind || net.width != variable.width;
  };
  std::vector<WaveDeclarations::Range>& ranges = declared_.ranges;
  ranges.erase(std::remove_if(ranges.begin(), ranges.end(), changes), ranges.end());
  for (WaveVariable& variable : variables) {
    const Net& net = nets_[variable.net];
    variable.kind = net.kind;
    variable.width = net.width;
    variable.is_event = net.is_event;
  }
}

}  // namespace vp
