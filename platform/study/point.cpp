#include <study/point.h>

#include <host/digest.h>

#include <algorithm>
#include <mutex>
#include <unordered_set>

namespace platform::study {

namespace {

/// Appends it as a JSON text.
void append_text(std::string& json, const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return c >= ' ' && c <= '~' && c != '"' && c != '\\';
  });
  if (!plain) {
    json += Json(text).dump();
    return;
  }
  json += '"';
  json += text;
  json += '"';
}

void add_line(std::string& json, const std::string& path, const std::string& value) {
  append_text(json, path);
  json += ':';
  append_text(json, value);
  json += ',';
}

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Word::Word(const std::string& text) {
  static std::mutex mutex;  // tables are written by two threads
  static std::unordered_set<std::string> words;
  const std::lock_guard<std::mutex> lock(mutex);
  text_ = &*words.insert(text).first;
}

const std::string* find(const Assignment& values, const std::string& path) {
  for (const auto& [name, value] : values) {
    if (name == path) return &value.text();
  }
  return nullptr;
}

std::map<std::string, std::string> Origins::settings(const Point& point) const {
  const std::map<std::string, std::string>& defaults = families[point.family].defaults;
  std::map<std::string, std::string> set;
  auto standard = defaults.begin();
  visit_configuration(point, [&](const std::string& path, const std::string& value) {
    while (standard != defaults.end() && standard->first < path) ++standard;
    const bool same =
        standard != defaults.end() && standard->first == path && standard->second == value;
    if (!same) set.emplace_hint(set.end(), path, value);
  });
  return set;
}

Setup Origins::setup(const Point& point) const {
  return {families[point.family].program, settings(point), input_sets[point.input_set].inputs,
          input};
}

std::string Origins::identity(const Point& point) const {
  return Identities(*this).of(point);
}

const Identities::Shared& Identities::shared_by(std::size_t family, std::size_t input_set) {
  constexpr std::size_t most_kept = 1000;  // 20 MB
  if (shared_.size() == most_kept) shared_.clear();
  const auto [known, is_new] = shared_.try_emplace({family, input_set});
  Shared& shared = known->second;
  if (!is_new) return shared;
  const Family& of_point = origins_.families[family];
  const InputChoice& input = origins_.input;
  shared.text = "{\"markervp\":" + origins_.program.dump();
  shared.text += ",\"tables\":" + origins_.tables.dump();
  shared.text += ",\"contents\":" + of_point.contents.dump();
  shared.text += ",\"inputs\":" + origins_.input_sets[input_set].contents.dump();
  shared.text += ",\"frames\":" + (input.frames ? std::to_string(*input.frames) : "null");
  shared.text += ",\"repeat\":" + std::to_string(input.repeat);
  shared.text += ",\"configuration\":{";
  for (const auto& [path, value] : of_point.configuration) {
    const std::size_t begin = shared.text.size();
    add_line(shared.text, path, value);
    shared.lines.push_back({path, begin, shared.text.size()});
  }
  return shared;
}

// Between the changes, which are sorted as the lines are, it is what the points share.
std::string Identities::of(const Point& point) {
  const Shared& shared = shared_by(point.family, point.input_set);
  std::string text;
  text.reserve(shared.text.size() + shared.text.size() / 8);
  std::size_t copied = 0;
  auto line = shared.lines.begin();
  for (const auto& [path, value] : point.changes) {
    line = std::lower_bound(line, shared.lines.end(), path.text(),
                            [](const Shared::Line& a, const std::string& b) { return a.path < b; });
    const bool is_there = line != shared.lines.end() && line->path == path.text();
    const std::size_t place = line == shared.lines.end() ? shared.text.size() : line->begin;
    text.append(shared.text, copied, place - copied);
    add_line(text, path, value);
    copied = is_there ? line->end : place;
  }
  text.append(shared.text, copied);
  if (text.back() == ',') text.pop_back();
  return text += "}}";
}

std::string key_of(std::string_view identity) {
  return host::content_hash(identity).substr(0, key_digits);
}

bool is_key(std::string_view text) {
  return text.size() == key_digits &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace platform::study
