#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <vp/error.h>
#include <vp/file.h>

namespace platform::host {

// How the program reads documents: vp::read_text for the bytes, vp::load_yaml for YAML, and what is
// below for JSON. All of them are bounded in size, depth and time, whatever the file holds.

/// The largest document that a program of ours writes: result.json of a long run. 1 GiB.
constexpr std::uint64_t largest_result = std::uint64_t{1} << 30;

/// No JSON for this program has more lists and objects inside each other.
constexpr std::size_t deepest_json = 64;

/// A tree of so many values takes less than 2 GB of memory.
constexpr std::size_t most_json_values = 20'000'000;

/// Throws vp::InputError "what, line 3, column 7: …" where lists and objects go deeper than
/// `deepest_json`, or values are more than `most_values`. nlohmann's trees are copied and
/// written recursively, and end the program if memory runs out while they are taken down.
void check_json_size(std::string_view text, const std::string& what,
                     std::size_t most_values = most_json_values);

/// Throws vp::InputError "what, line 3, column 7: this is not JSON …"; `byte` counts from 1.
[[noreturn]] void fail_no_json(std::string_view text, std::size_t byte, const std::string& what);

/// The tree of a text that anybody may have written; `what` names it in messages: "result 'x'".
/// `keep` may take values out of the tree as they are read (nlohmann's parser_callback_t); then
/// there may be any number of them. Throws vp::InputError.
template <class Json = nlohmann::json>
Json parse_json(std::string_view text, const std::string& what,
                const typename Json::parser_callback_t& keep = nullptr) {
  check_json_size(text, what, keep ? text.size() : most_json_values);
  try {
    return Json::parse(text, keep);
  } catch (const typename Json::parse_error& error) {
    fail_no_json(text, error.byte, what);
  } catch (const typename Json::out_of_range&) {
    throw vp::InputError(what + ": a number in it is too large");
  }
}

/// The same for a file.
template <class Json = nlohmann::json>
Json read_json(const std::filesystem::path& path, const std::string& what,
               std::uint64_t most = vp::largest_by_hand) {
  return parse_json<Json>(vp::read_text(path, what, most), what + " '" + path.string() + "'");
}

/// What was made of documents, kept as long as their text is the same: a process that computes many
/// points reads the same tables for each.
template <class Value>
class KeptDocuments {
 public:
  /// What `make(text)` returned for this file when it had the same text; else what it returns now.
  template <class Make>
  std::shared_ptr<const Value> get(const std::filesystem::path& path, const std::string& text,
                                   const Make& make) {
    constexpr std::size_t most_kept = 16;
    const auto known = kept_.find(path.string());
    if (known != kept_.end() && known->second.text == text) return known->second.value;
    auto value = std::make_shared<const Value>(make(text));
    if (kept_.size() == most_kept) kept_.clear();
    kept_.insert_or_assign(path.string(), Kept{text, value});
    return value;
  }

 private:
  struct Kept {
    std::string text;
    std::shared_ptr<const Value> value;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace platform::host
