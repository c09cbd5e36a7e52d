#include <fcntl.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/wave_reader.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "fst_reader.h"
#include "wave_input.h"

namespace vp {

namespace {

constexpr std::size_t deepest = 1000;
constexpr unsigned widest = 1 << 20;
/// Codes of up to three characters, as nearly all are, are looked up in a table.
constexpr std::size_t short_code = 3;
constexpr const char* too_long =
    "a word, or white space, longer than 256 KiB: the file is corrupt, or no VCD";

std::size_t code_index(std::string_view code) {
  std::size_t index = 0;
  for (const char c : code) {
    if (c < '!' || c > '~') return std::numeric_limits<std::size_t>::max();
    index = index * 94 + static_cast<std::size_t>(c - '!') + 1;
  }
  return index;
}

/// For messages: what a file says may be anything.
std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text;
  for (const char c : word.substr(0, longest)) text += c > ' ' && c <= '~' ? c : '?';
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

/// Undoes the escapes of GTKWave: \x41, \101, \n and so on.
void unescape(std::string_view from, std::string& to) {
  to.clear();
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] != '\\' || i + 1 == from.size()) {
      to += from[i];
      continue;
    }
    const bool hexadecimal = from[i + 1] == 'x';
    const std::string_view digits = from.substr(i + (hexadecimal ? 2 : 1), hexadecimal ? 2 : 3);
    unsigned value = 0;
    const auto end =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 8);
    if (end.ec == std::errc() && end.ptr == digits.data() + digits.size()) {
      to += static_cast<char>(value);
      i += digits.size() + (hexadecimal ? 1 : 0);
    } else {
      constexpr std::string_view letters = "nrt", meant = "\n\r\t";
      const auto letter = letters.find(from[++i]);
      to += letter == std::string_view::npos ? from[i] : meant[letter];
    }
  }
}

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& file) : file_(file, "trace") {
    ::posix_fadvise(file_.descriptor(), 0, 0, POSIX_FADV_SEQUENTIAL);
  }

  std::size_t read(char* to, std::size_t size) override {
    return file_.read(to, size, InputFile::HostClock::now() + InputFile::patience);
  }

 private:
  InputFile file_;
};

/// An FST begins with its header block, type 0, or is packed as a whole, type 254.
bool looks_like_fst(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  FileSource source(file);
  unsigned char first = 'x';
  return source.read(reinterpret_cast<char*>(&first), 1) == 1 && (first == 0 || first == 254);
}

}  // namespace

WaveReader::WaveReader(const std::filesystem::path& file) : file_(file) {
  if (looks_like_fst(file)) {
    fst_ = std::make_unique<FstReader>(file);
    read_fst_header();
  } else {
    tokens_ = std::make_unique<VcdTokens>(std::make_unique<FileSource>(file));
    read_header();
  }
}

WaveReader::~WaveReader() = default;

std::uint64_t WaveReader::bytes() const {
  return fst_ ? fst_->bytes() : tokens_->bytes();
}

std::string WaveReader::remark() const {
  return fst_ ? fst_->remark() : std::string();
}

const WaveVariable* WaveReader::find(const std::string& path) const {
  const auto found = by_path_.find(path);
  return found == by_path_.end() ? nullptr : &variables_[found->second];
}

void WaveReader::select_all() {
  for (const WaveVariable& variable : variables_) nets_[variable.net].selected = true;
}

void WaveReader::fail(const std::string& problem) const {
  std::string place;
  if (tokens_) {
    place = ", line " + std::to_string(tokens_->line()) + " (byte " +
            std::to_string(tokens_->offset()) + ")";
  }
  throw InputError("trace '" + file_.string() + "'" + place + ": " + problem);
}

std::string_view WaveReader::next(const char* inside) {
  const std::string_view word = tokens_->next();
  if (tokens_->too_long()) fail(too_long);
  if (word.empty() || tokens_->cut()) {
    fail(std::string("the file ends in the middle of ") + inside + ": it is truncated");
  }
  return word;
}

void WaveReader::skip_to_end(const char* inside) {
  while (next(inside) != "$end") continue;
}

void WaveReader::read_header() {
  for (bool first = true;; first = false) {
    const std::string_view word = next("the header");
    if (word == "$enddefinitions") {
      skip_to_end("the header");
      break;
    }
    if (word == "$timescale") {
      read_timescale();
    } else if (word == "$scope") {
      read_scope();
    } else if (word == "$upscope") {
      if (scopes_.empty()) fail("$upscope without $scope");
      scopes_.pop_back();
      skip_to_end("$upscope");
    } else if (word == "$var") {
      read_variable();
    } else if (word.front() == '$' && word != "$end") {
      skip_to_end("the header");  // $date, $version, $comment, $attrbegin and what others add
    } else {
      fail((first ? "begins with " : "unexpected ") + shown(word) +
           (first ? ": this is no VCD" : " in the header"));
    }
  }
  if (timescale_fs_ == 0) fail("the header has no $timescale");
  if (variables_.empty()) fail("the header declares no signal");
}

void WaveReader::read_fst_header() {
  timescale_fs_ = fst_->timescale_fs();
  for (const FstReader::Net& net : fst_->nets()) nets_.push_back({net.kind, net.width, false});
  for (WaveVariable& variable : fst_->variables()) declare(std::move(variable));
  if (variables_.empty()) fail("it declares no signal");
}

void WaveReader::read_timescale() {
  std::string text;
  for (std::string_view word = next("$timescale"); word != "$end"; word = next("$timescale")) {
    if (text.size() < 64) text += word;
  }
  struct Scale {
    const char* unit;
    std::uint64_t fs;
  };
  static constexpr Scale scales[] = {{"fs", 1},
                                     {"ps", 1000},
                                     {"ns", 1'000'000},
                                     {"us", 1'000'000'000},
                                     {"ms", 1'000'000'000'000},
                                     {"s", 1'000'000'000'000'000}};
  for (const Scale& scale : scales) {
    for (const unsigned factor : {1u, 10u, 100u}) {
      if (text == std::to_string(factor) + scale.unit) timescale_fs_ = factor * scale.fs;
    }
  }
  if (timescale_fs_ == 0) {
    fail("the timescale " + shown(text) +
         " is none: it must be 1, 10 or 100 of fs, ps, ns, us, ms or s");
  }
}

void WaveReader::read_scope() {
  next("$scope");  // module, task, begin …
  std::string name(next("$scope"));
  if (name == "$end") fail("$scope without a name");
  if (scopes_.size() == deepest) fail("more than 1000 scopes inside each other");
  scopes_.push_back(std::move(name));
  skip_to_end("$scope");
}

void WaveReader::read_variable() {
  const std::string type(next("$var"));
  const std::string size(next("$var"));
  const std::string code(next("$var"));
  std::string name(next("$var"));
  if (type == "$end" || size == "$end" || code == "$end" || name == "$end") {
    fail("$var needs a type, a size, an identifier and a name");
  }
  skip_to_end("$var");  // its range

  WaveVariable variable;
  if (type == "real" || type == "realtime" || type == "shortreal" || type == "real_parameter") {
    variable.kind = WaveVariable::Kind::real;
  } else if (type == "string") {
    variable.kind = WaveVariable::Kind::text;
  }
  const auto parsed = std::from_chars(size.data(), size.data() + size.size(), variable.width);
  const bool is_bits = variable.kind == WaveVariable::Kind::bits;
  if (parsed.ec != std::errc() || parsed.ptr != size.data() + size.size() ||
      variable.width > widest || (is_bits && variable.width == 0)) {
    fail("the size " + shown(size) + " of signal " + shown(name) + " is none");
  }
  for (const std::string& scope : scopes_) variable.path += scope + ".";
  variable.path += name;
  variable.net = declare_net(code, variable.kind, is_bits ? variable.width : 1);
  declare(std::move(variable));
}

/// Its path may end with a range.
void WaveReader::declare(WaveVariable variable) {
  std::string& path = variable.path;
  const std::size_t range = path.find_last_of('[');
  if (range != std::string::npos && range > 0 && path[range - 1] != '.' && path.back() == ']' &&
      path.find(':', range) != std::string::npos) {
    path.erase(range);
  }
  if (!by_path_.emplace(variable.path, variables_.size()).second) {
    fail("signal " + shown(variable.path) + " is declared twice");
  }
  variables_.push_back(std::move(variable));
}

std::uint32_t WaveReader::declare_net(std::string_view code, WaveVariable::Kind kind,
                                      unsigned width) {
  const std::size_t index = code_index(code);
  if (index == std::numeric_limits<std::size_t>::max()) {
    fail("the identifier " + shown(code) + " has characters that are not printable");
  }
  std::uint32_t* place = nullptr;
  if (code.size() <= short_code) {
    if (index >= by_short_code_.size()) by_short_code_.resize(index + 1);
    place = &by_short_code_[index];
  } else {
    place = &by_long_code_[std::string(code)];
  }
  if (*place == 0) {
    nets_.push_back({kind, width, false});
    *place = nets();
  }
  const Net& net = nets_[*place - 1];
  if (net.kind != kind || net.width != width) {
    fail("the identifier " + shown(code) + " is declared twice, with different types or sizes");
  }
  return *place - 1;
}

std::uint32_t WaveReader::net_of(std::string_view code) {
  std::uint32_t net = 0;
  if (code.size() <= short_code) {
    const std::size_t index = code_index(code);
    if (index < by_short_code_.size()) net = by_short_code_[index];
  } else {
    const auto found = by_long_code_.find(std::string(code));
    if (found != by_long_code_.end()) net = found->second;
  }
  if (net == 0) fail("the identifier " + shown(code) + " was not declared");
  return net - 1;
}

void WaveReader::read(WaveHandler& handler) {
  if (fst_) {
    std::vector<bool> selected;
    for (const Net& net : nets_) selected.push_back(net.selected);
    fst_->read(
        selected, [&](std::uint64_t steps) { return reach(steps, handler); }, handler);
    return;
  }
  for (;;) {
    const std::string_view word = tokens_->next();
    if (tokens_->too_long()) fail(too_long);
    if (word.empty()) return;
    if (tokens_->cut()) fail("the file ends in the middle of a line: it is truncated");
    switch (word.front()) {
      case '#':
        if (!read_time(word.substr(1), handler)) return;
        break;
      case '0':
      case '1':
      case 'x':
      case 'X':
      case 'z':
      case 'Z':
        read_scalar(word, handler);
        break;
      case 'b':
      case 'B':
        read_vector(word, handler);
        break;
      case 'r':
      case 'R':
        read_real(word, handler);
        break;
      case 's':
      case 'S':
        read_text(word, handler);
        break;
      case '$':
        if (word == "$comment") {
          skip_to_end("$comment");
        } else if (word != "$dumpvars" && word != "$dumpall" && word != "$dumpon" &&
                   word != "$dumpoff" && word != "$end") {
          fail("unknown keyword " + shown(word));
        }
        break;
      default:
        fail("unexpected " + shown(word) + ": the file is corrupt");
    }
  }
}

bool WaveReader::read_time(std::string_view digits, WaveHandler& handler) {
  std::uint64_t steps = 0;
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), steps);
  if (end.ec != std::errc() || end.ptr != digits.data() + digits.size()) {
    fail("the time " + shown(digits) + " is none");
  }
  return reach(steps, handler);
}

/// In steps of the file's time. False: the handler has enough.
bool WaveReader::reach(std::uint64_t steps, WaveHandler& handler) {
  constexpr std::uint64_t fs_per_ps = 1000;
  const auto fs = static_cast<unsigned __int128>(steps) * timescale_fs_;
  if (fs / fs_per_ps > std::numeric_limits<std::int64_t>::max()) {
    fail("the time " + std::to_string(steps) + " is too late: more than 106 days");
  }
  const auto ps = static_cast<std::uint64_t>(fs / fs_per_ps);
  if (started_ && ps < now_ps_) fail("the time falls to " + std::to_string(steps));
  if (started_ && ps == now_ps_) return true;
  started_ = true;
  now_ps_ = ps;
  return handler.at(ps);
}

void WaveReader::read_scalar(std::string_view token, WaveHandler& handler) {
  const std::uint32_t id = net_of(token.substr(1));
  const Net& net = nets_[id];
  if (!net.selected) return;
  if (net.kind != WaveVariable::Kind::bits) fail("a bit for a signal that is real or a text");
  WaveValue value;
  value.known = token.front() <= '1';
  value.bits = token.front() == '1';
  value.text = token.substr(0, 1);
  handler.change(id, value);
}

std::uint32_t WaveReader::value_and_net(std::string_view token, std::string_view& value) {
  tokens_->keep(token);
  const std::string_view code = next("a value");
  value = tokens_->kept(token.size()).substr(1);
  return net_of(code);
}

std::uint64_t WaveReader::decode(std::string_view digits, bool& known) const {
  std::uint64_t bits = 0;
  known = true;
  for (const char c : digits) {
    bits = bits << 1 | (c & 1);
    if (c == '0' || c == '1') continue;
    if (std::string_view("xXzZuUwWlLhH-").find(c) == std::string_view::npos) {
      fail(shown(digits) + " is no binary number");
    }
    known = false;
  }
  return known ? bits : 0;
}

void WaveReader::read_vector(std::string_view token, WaveHandler& handler) {
  WaveValue value;
  const std::uint32_t id = value_and_net(token, value.text);
  const Net& net = nets_[id];
  if (!net.selected) return;
  if (net.kind != WaveVariable::Kind::bits) fail("bits for a signal that is real or a text");
  if (value.text.empty() || value.text.size() > net.width) {
    fail("a value of " + std::to_string(value.text.size()) + " digits for a signal of " +
         std::to_string(net.width) + " bits");
  }
  value.bits = decode(value.text, value.known);
  handler.change(id, value);
}

void WaveReader::read_real(std::string_view token, WaveHandler& handler) {
  WaveValue value;
  const std::uint32_t id = value_and_net(token, value.text);
  const Net& net = nets_[id];
  if (!net.selected) return;
  if (net.kind != WaveVariable::Kind::real) fail("a real number for a signal of bits or text");
  value.kind = net.kind;
  const char* const end = value.text.data() + value.text.size();
  const auto parsed = std::from_chars(value.text.data(), end, value.real);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != end) {
    fail(shown(value.text) + " is no number");
  }
  value.known = std::isfinite(value.real);
  handler.change(id, value);
}

void WaveReader::read_text(std::string_view token, WaveHandler& handler) {
  WaveValue value;
  const std::uint32_t id = value_and_net(token, value.text);
  const Net& net = nets_[id];
  if (!net.selected) return;
  if (net.kind != WaveVariable::Kind::text) fail("a text for a signal that is none");
  unescape(value.text, text_);
  value.kind = net.kind;
  value.known = true;
  value.text = text_;
  handler.change(id, value);
}

}  // namespace vp
