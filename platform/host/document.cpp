#include <host/document.h>

#include <algorithm>

#include <vp/error.h>

namespace platform::host {

namespace {

/// "what, line 3, column 7: problem" for the character at `at`.
[[noreturn]] void fail(std::string_view text, std::size_t at, const std::string& what,
                       const std::string& problem) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
  throw vp::InputError(what + ", line " + std::to_string(line) + ", column " +
                       std::to_string(column) + ": " + problem);
}

}  // namespace

void check_json_size(std::string_view text, const std::string& what, std::size_t most_values) {
  std::size_t depth = 0, values = 1;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json) {
        fail(text, i, what,
             "more than " + std::to_string(deepest_json) +
                 " lists and objects inside each other: this is no file for markervp");
      }
      ++values;
    } else if (c == ',') {
      ++values;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
    if (values > most_values)
      fail(text, i, what, "more than 20 million values: compute fewer frames or points at a time");
  }
}

void fail_no_json(std::string_view text, std::size_t byte, const std::string& what) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw vp::InputError(what + ": it is empty, which is not JSON");
  fail(text, byte == 0 ? 0 : byte - 1, what,
       "this is not JSON, or not whole: make the file again, or correct it");
}

}  // namespace platform::host
