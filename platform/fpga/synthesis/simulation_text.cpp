#include <fpga/synthesis/simulation_text.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace platform::synthesis {

namespace {

using Words = std::set<std::string_view>;

const Words ending{"$error", "$fatal", "$finish", "$stop"};
const Words silent{"$display",        "$write",   "$info",      "$warning",  "$timeformat",
                   "$printtimescale", "$monitor", "$strobe",    "$fdisplay", "$fwrite",
                   "$fclose",         "$fflush",  "$assertoff", "$asserton", "$assertkill"};
const Words procedures{"initial", "final", "always", "always_ff", "always_comb", "always_latch"};
const Words routines{"function", "task"};
const Words cases{"case", "casex", "casez"};
const Words closers{"end", "endcase", "join", "join_any", "join_none", "endfunction", "endtask"};
const Words assertions{"assert", "assume", "cover", "restrict"};

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$' || c == '`';
}

/// Where what begins at `at` ends, if that is no code: a comment, a string. Otherwise `at`.
std::size_t behind_text(const std::string& text, std::size_t at) {
  const auto behind = [&](const char* end) {
    const std::size_t found = text.find(end, at + 2);
    return found == text.npos ? text.size() : found + std::string_view(end).size();
  };
  if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
  if (text.compare(at, 2, "/*") == 0) return behind("*/");
  if (text[at] != '"') return at;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

struct Token {
  std::size_t at;
  std::string_view text;
};

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t behind = behind_text(text, at);
    if (behind != at) {
      at = behind;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && in_word(text[end])) ++end;
    if (end == at) ++end;
    if (std::isspace(static_cast<unsigned char>(text[at])) == 0)
      tokens.push_back({at, std::string_view(text).substr(at, end - at)});
    at = end;
  }
  return tokens;
}

/// Goes through the tokens, and knows which are in procedures.
class Reader {
 public:
  Reader(const std::string& text, const std::string& ends)
      : text_(text), ends_(ends), tokens_(tokens_of(text)) {}

  std::string read() {
    for (std::size_t i = 0; i < tokens_.size();) {
      const std::string_view word = tokens_[i].text;
      if (assertions.count(word) > 0) {
        i = drop_assertion(i);
      } else if (in_procedure_ && (ending.count(word) > 0 || silent.count(word) > 0)) {
        i = replace(i, behind_statement(i),
                    ending.count(word) > 0
                        ? "$display(\"" + ends_ + std::to_string(line_of(tokens_[i].at)) + "\");"
                        : ";");
      } else if (in_procedure_ && is_step_before(i)) {
        i = step_behind(i);
      } else {
        follow(i++);
      }
    }
    return out_ + text_.substr(copied_);
  }

 private:
  std::string_view word(std::size_t i) const {
    return i < tokens_.size() ? tokens_[i].text : std::string_view();
  }
  std::size_t line_of(std::size_t at) const {
    return 1 + static_cast<std::size_t>(std::count(
                   text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

  /// Whether a procedure begins or ends with token `i`.
  void follow(std::size_t i) {
    const std::string_view now = word(i);
    if (!in_procedure_) {
      const bool prototype = i > 0 && (word(i - 1) == "import" || word(i - 1) == "extern");
      const bool routine = routines.count(now) > 0 && !prototype;
      in_procedure_ = procedures.count(now) > 0 || routine;
      if (routine) open_.push_back(false);
      return;
    }
    if (now == "(") ++parentheses_;
    if (now == ")") --parentheses_;
    if (now == "begin" || now == "fork" || cases.count(now) > 0)
      open_.push_back(cases.count(now) > 0);
    if (closers.count(now) > 0 && !open_.empty()) open_.pop_back();
    if (now == ";" || closers.count(now) > 0) end_statement(i + 1);
  }
  void end_statement(std::size_t next) {
    if (open_.empty() && parentheses_ == 0 && word(next) != "else") in_procedure_ = false;
  }

  /// Behind the semicolon that ends the statement of token `i`, or its `end`.
  std::size_t behind_statement(std::size_t i) const {
    unsigned parentheses = 0, blocks = 0;
    for (; i < tokens_.size(); ++i) {
      const std::string_view now = word(i);
      if (now == "(") ++parentheses;
      if (now == ")" && parentheses > 0) --parentheses;
      if (now == "begin") ++blocks;
      if (now == "end" && blocks > 0 && --blocks == 0) return i + 1;
      if (now == ";" && parentheses == 0 && blocks == 0) return i + 1;
    }
    return i;
  }

  /// With its label, and what it does when it holds or fails.
  std::size_t drop_assertion(std::size_t i) {
    std::size_t end = behind_statement(i);
    if (word(end) == "else") end = behind_statement(end);
    const bool item = !open_.empty() && open_.back();  // of a case: no label
    const bool labelled = i >= 2 && word(i - 1) == ":" && !item && in_word(word(i - 2).front());
    return replace(labelled ? i - 2 : i, end, in_procedure_ ? ";" : "");
  }

  /// `++i` of a loop, or as a statement, which Yosys knows as `i++`.
  bool is_step_before(std::size_t i) const {
    const bool signs =
        (word(i) == "+" && word(i + 1) == "+") || (word(i) == "-" && word(i + 1) == "-");
    if (!signs || tokens_[i].at + 1 != tokens_[i + 1].at || i == 0) return false;
    const std::string_view before = word(i - 1), behind = word(i + 3);
    return !word(i + 2).empty() && in_word(word(i + 2).front()) &&
           (before == ";" || before == ")" || before == "begin" || before == "else") &&
           (behind == ";" || behind == ")");
  }
  std::size_t step_behind(std::size_t i) {
    const std::string sign(2, word(i).front());
    out_ += text_.substr(copied_, tokens_[i].at - copied_) + std::string(word(i + 2)) + sign;
    copied_ = tokens_[i + 2].at + word(i + 2).size();
    return i + 3;
  }

  /// Tokens from `first` up to `end` by a statement, in as many lines.
  std::size_t replace(std::size_t first, std::size_t end, const std::string& statement) {
    const std::size_t from = tokens_[first].at;
    const std::size_t to =
        end < tokens_.size() ? tokens_[end - 1].at + word(end - 1).size() : text_.size();
    out_ += text_.substr(copied_, from - copied_) + statement;
    for (std::size_t at = from; at < to; ++at) {
      if (text_[at] == '\n') out_ += text_[at - 1] == '\\' ? "\\\n" : "\n";
    }
    copied_ = to;
    if (in_procedure_) end_statement(end);
    return end;
  }

  const std::string& text_;
  const std::string& ends_;
  const std::vector<Token> tokens_;
  std::string out_;
  std::size_t copied_ = 0;  ///< so much of the text is in out_ or dropped
  bool in_procedure_ = false;
  int parentheses_ = 0;
  std::vector<bool> open_;  ///< blocks of the procedure; true: a case
};

}  // namespace

std::string without_simulation(const std::string& text, const std::string& ends) {
  return Reader(text, ends).read();
}

}  // namespace platform::synthesis
