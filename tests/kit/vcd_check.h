#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// A small, strict VCD reader for tests: whatever our writer should not write is an error.
class VcdCheck {
 public:
  struct Variable {
    std::string type;
    unsigned width = 0;
    /// Time and value as written: "0", "101", "2.5".
    std::vector<std::pair<std::uint64_t, std::string>> changes;
  };

  /// `ours` false: also what other programs write that means the same (a date, leading zeros).
  explicit VcdCheck(const std::string& text, bool ours = true) : in_(text), ours_(ours) {
    if (!text.empty() && text.back() != '\n') fail("no line end at the end of the file");
    while (!defined_) declaration();
    for (std::string word; in_ >> word;) event(word);
    if (values_due_ != 0) fail("$dumpvars does not give every value");
  }

  static VcdCheck of_file(const std::string& path) { return VcdCheck(text_of(path)); }
  static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  const std::map<std::string, Variable>& variables() const { return variables_; }
  bool has(const std::string& path) const { return variables_.count(path) != 0; }
  const Variable& variable(const std::string& path) const {
    const auto found = variables_.find(path);
    if (found == variables_.end()) fail("there is no variable " + path);
    return found->second;
  }
  /// The value standing at `ps`, as written.
  std::string value(const std::string& path, std::uint64_t ps) const {
    std::string value = "none";
    for (const auto& [at, changed] : variable(path).changes) {
      if (at <= ps) value = changed;
    }
    return value;
  }
  std::uint64_t start_ps() const { return start_ps_; }
  std::uint64_t end_ps() const { return now_ps_; }
  const std::string& comment() const { return comment_; }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw std::runtime_error("bad VCD: " + what);
  }
  static void require(bool condition, const std::string& what) {
    if (!condition) fail(what);
  }

  std::string next() {
    std::string word;
    if (!(in_ >> word)) fail("unexpected end");
    return word;
  }
  std::string until_end() {
    std::string text;
    for (std::string word = next(); word != "$end"; word = next()) {
      text += (text.empty() ? "" : " ") + word;
    }
    return text;
  }

  void declaration() {
    const std::string word = next();
    if (word == "$version") {
      require(until_end() == "markervp", "$version");
    } else if (word == "$date" && !ours_) {
      until_end();
    } else if (word == "$timescale") {
      require(until_end() == "1ps", "$timescale");
    } else if (word == "$scope") {
      require(next() == "module", "$scope");
      scopes_.push_back(next());
      require(until_end().empty(), "$scope");
    } else if (word == "$upscope") {
      require(!scopes_.empty() && until_end().empty(), "$upscope");
      scopes_.pop_back();
    } else if (word == "$var") {
      declare();
    } else if (word == "$enddefinitions") {
      require(scopes_.empty() && until_end().empty(), "$enddefinitions");
      defined_ = true;
    } else {
      fail("unknown declaration " + word);
    }
  }

  void declare() {
    Variable variable;
    variable.type = next();
    require(variable.type == "wire" || variable.type == "reg" || variable.type == "real", "type");
    variable.width = static_cast<unsigned>(std::stoul(next()));
    const std::string code = next();
    std::string path;
    for (const std::string& scope : scopes_) path += scope + ".";
    path += next();
    const bool range = variable.width > 1 && variable.type != "real";
    require(until_end() == (range ? "[" + std::to_string(variable.width - 1) + ":0]" : ""),
            "range");
    require(paths_.emplace(code, path).second, "identifier " + code + " twice");
    require(variables_.emplace(path, variable).second, "variable " + path + " twice");
  }

  void event(const std::string& word) {
    if (word[0] == '#') {
      const std::uint64_t ps = std::stoull(word.substr(1));
      require(!started_ || ps > now_ps_, "time " + word + " does not rise");
      require(values_due_ == 0, "time inside $dumpvars");
      if (!started_) start_ps_ = ps;
      started_ = true;
      now_ps_ = ps;
    } else if (word == "$dumpvars") {
      require(started_ && !dumped_, "$dumpvars");
      dumped_ = true;
      values_due_ = variables_.size();
    } else if (word == "$end") {
      require(values_due_ == 0, "$dumpvars does not give every value");
    } else if (word == "$comment") {
      comment_ = until_end();
    } else if (word[0] == 'b' || word[0] == 'r') {
      change(next(), word.substr(1), word[0]);
    } else {
      change(word.substr(1), word.substr(0, 1), 's');
    }
  }

  void change(const std::string& code, std::string value, char form) {
    if (form == 'b' && !ours_) value.erase(0, std::min(value.find('1'), value.size() - 1));
    const auto path = paths_.find(code);
    require(path != paths_.end(), "unknown identifier " + code);
    Variable& variable = variables_[path->second];
    require(dumped_, "value before $dumpvars");
    const char expected = variable.type == "real" ? 'r' : variable.width == 1 ? 's' : 'b';
    require(form == expected, "form of the value of " + path->second);
    if (form == 'r') {
      char* end = nullptr;
      std::strtod(value.c_str(), &end);
      require(*end == 0, "number " + value);
    } else {
      require(value.find_first_not_of("01") == std::string::npos && !value.empty() &&
                  value.size() <= variable.width && (value.size() == 1 || value[0] == '1'),
              "digits " + value + " of " + path->second);
    }
    if (values_due_ > 0) {
      require(variable.changes.empty(), "two initial values of " + path->second);
      --values_due_;
    } else {
      require(variable.changes.back().second != value, path->second + " does not change");
    }
    variable.changes.emplace_back(now_ps_, value);
  }

  std::istringstream in_;
  bool ours_;
  bool defined_ = false, started_ = false, dumped_ = false;
  std::size_t values_due_ = 0;
  std::uint64_t start_ps_ = 0, now_ps_ = 0;
  std::string comment_;
  std::vector<std::string> scopes_;
  std::map<std::string, std::string> paths_;  ///< by identifier code
  std::map<std::string, Variable> variables_;
};
