#include <fpga/power/saif.h>

#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace platform::power {

namespace {

constexpr std::uint64_t largest_saif = std::uint64_t{1} << 30;
const std::map<std::string, double> units{{"s", 1e12}, {"ms", 1e9}, {"us", 1e6},
                                          {"ns", 1e3}, {"ps", 1},   {"fs", 1e-3}};  ///< in ps

class SaifReader {
 public:
  explicit SaifReader(const std::string& file)
      : file_(file), text_(vp::read_text(file, "SAIF", largest_saif)) {}

  Saif read() {
    while (const std::optional<Token> token = next()) {
      if (token->kind == Token::opens) {
        open();
      } else if (token->kind == Token::closes) {
        if (lists_.empty()) fail("')' closes nothing");
        close();
      } else {
        if (lists_.empty()) fail("is no SAIF: it does not begin with (SAIFILE");
        lists_.back().words.push_back(token->text);
      }
    }
    if (!lists_.empty()) fail("ends inside a list: it is cut off");
    if (!is_saif_) fail("is no SAIF: it does not begin with (SAIFILE");
    if (steps_ == 0 || step_ps_ <= 0) fail("has no DURATION and TIMESCALE above 0");
    saif_.duration_ps = static_cast<double>(steps_) * step_ps_;
    return std::move(saif_);
  }

 private:
  struct Token {
    enum Kind : std::uint8_t { opens, closes, word } kind;
    std::string text;
  };
  /// "(NET (clk (T0 5) (T1 5) (TC 2)))" are three lists inside each other.
  struct List {
    std::vector<std::string> words;  ///< outside of the lists in it; the first says what it is
    std::size_t outer_path = 0;      ///< length of the path around it
    bool is_entered = false;         ///< the path has its name
    std::uint64_t high = 0;
    std::optional<std::uint64_t> toggles;

    bool is(std::string_view name) const { return !words.empty() && words[0] == name; }
  };

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError("SAIF '" + file_ + "', line " + std::to_string(line_) + ": " + problem);
  }

  /// Blanks, and comments as in C++.
  void skip_blanks() {
    while (at_ < text_.size()) {
      const std::string_view rest = std::string_view(text_).substr(at_);
      std::size_t length = 1;
      if (rest.substr(0, 2) == "//") {
        length = std::min(rest.find('\n'), rest.size());
      } else if (rest.substr(0, 2) == "/*") {
        const std::size_t end = rest.find("*/", 2);
        if (end == std::string_view::npos) fail("a comment does not end");
        length = end + 2;
      } else if (blanks.find(rest[0]) == std::string_view::npos) {
        return;
      }
      for (const char c : rest.substr(0, length)) line_ += c == '\n';
      at_ += length;
    }
  }

  std::optional<Token> next() {
    skip_blanks();
    if (at_ == text_.size()) return std::nullopt;
    if (text_[at_] == '(') return ++at_, Token{Token::opens, ""};
    if (text_[at_] == ')') return ++at_, Token{Token::closes, ""};
    if (text_[at_] == '"') return quoted();
    std::string word;
    for (; at_ < text_.size() && ends_of_words.find(text_[at_]) == std::string_view::npos; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      word += text_[at_];
    }
    return Token{Token::word, word};
  }

  Token quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string::npos) fail("a quoted text does not end");
    Token token{Token::word, text_.substr(at_ + 1, end - at_ - 1)};
    for (const char c : token.text) line_ += c == '\n';
    at_ = end + 1;
    return token;
  }

  void open() {
    if (!lists_.empty()) {
      List& outer = lists_.back();
      if (outer.is("INSTANCE") && !outer.is_entered) enter(outer);
    }
    lists_.emplace_back().outer_path = path_.size();
  }

  /// (INSTANCE "type" name …: some tools give the type, too.
  void enter(List& instance) {
    if (instance.words.size() < 2) fail("an INSTANCE has no name");
    path_ += instance.words.back() + ".";
    instance.is_entered = true;
  }

  void close() {
    const List list = std::move(lists_.back());
    lists_.pop_back();
    path_.resize(list.outer_path);
    if (list.words.empty()) return;
    if (lists_.empty()) {
      is_saif_ = is_saif_ || list.is("SAIFILE");
    } else if (lists_.back().is("NET") || lists_.back().is("PORT")) {
      if (!list.toggles) fail("'" + vp::excerpt(list.words[0]) + "' has no TC");
      saif_.bits.push_back({path_ + list.words[0], list.high, *list.toggles});
    } else if (list.is("T1")) {
      lists_.back().high = number(list);
    } else if (list.is("TC")) {
      lists_.back().toggles = number(list);
    } else if (list.is("DURATION")) {
      steps_ = number(list);
    } else if (list.is("TIMESCALE")) {
      set_timescale(list);
    }
  }

  std::uint64_t number(const List& list) const {
    std::uint64_t value = 0;
    if (list.words.size() == 2) {
      const std::string& word = list.words[1];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error == std::errc() && end == word.data() + word.size()) return value;
    }
    fail(list.words[0] + " takes a whole number");
  }

  /// "1ps", or "1 ps" in two words.
  void set_timescale(const List& list) {
    const std::string text = vp::join({list.words.begin() + 1, list.words.end()}, "");
    const std::size_t unit = text.find_first_not_of("0123456789");
    const auto found = unit == std::string::npos ? units.end() : units.find(text.substr(unit));
    if (found == units.end() || unit == 0 || unit > 3)
      fail("'" + vp::excerpt(text) + "' is no TIMESCALE: it is written like 1 ps");
    step_ps_ = std::stod(text.substr(0, unit)) * found->second;
  }

  static constexpr std::string_view blanks = " \t\r\n", ends_of_words = " \t\r\n()";

  std::string file_, text_;
  std::size_t at_ = 0, line_ = 1;
  std::vector<List> lists_;
  std::string path_;  ///< of the instance, with a '.' behind each level
  bool is_saif_ = false;
  std::uint64_t steps_ = 0;
  double step_ps_ = 0;
  Saif saif_;
};

}  // namespace

Saif read_saif(const std::string& file) {
  return SaifReader(file).read();
}

}  // namespace platform::power
