#include <marker/input/image_sequence.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include <vp/error.h>

namespace platform::input {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_digits = 9;

constexpr const char* numerals = "0123456789";

/// A name with a number in it: "img_%04d.png".
struct Pattern {
  std::string before, after;
  std::size_t width = 0;  ///< digits at least
  bool has_zeros = false;

  std::string name(std::uint64_t number) const {
    const std::string digits = std::to_string(number);
    const std::size_t missing = width - std::min(width, digits.size());
    return before + std::string(missing, has_zeros ? '0' : ' ') + digits + after;
  }

  /// The number in a file's name; none if it is another one's.
  std::optional<std::uint64_t> number_in(const std::string& file) const {
    if (file.size() <= before.size() + after.size()) return std::nullopt;
    const std::size_t length = file.size() - before.size() - after.size();
    const std::size_t digits = std::min(file.find_first_not_of(' ', before.size()), file.size());
    if (before.size() + length - digits > most_digits ||
        file.find_first_of(numerals, digits) != digits)
      return std::nullopt;
    const std::uint64_t number = std::stoull(file.substr(digits, before.size() + length - digits));
    return name(number) == file ? std::optional(number) : std::nullopt;
  }
};

std::optional<Pattern> pattern_of(const std::string& name) {
  const std::size_t percent = name.find('%');
  if (percent == std::string::npos || name.find('%', percent + 1) != std::string::npos)
    return std::nullopt;
  Pattern pattern;
  std::size_t at = percent + 1;
  pattern.has_zeros = at < name.size() && name[at] == '0';
  const std::size_t end = std::min(name.find_first_not_of(numerals, at), name.size());
  if (end - at > most_digits) return std::nullopt;
  if (end > at) pattern.width = std::stoul(name.substr(at, end - at));
  if (end == name.size() || name[end] != 'd' || pattern.width > most_digits) return std::nullopt;
  pattern.before = name.substr(0, percent);
  pattern.after = name.substr(end + 1);
  return pattern;
}

}  // namespace

bool is_sequence(const std::string& path) {
  return pattern_of(fs::path(path).filename().string()).has_value();
}

ImageSequence find_sequence(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const Pattern pattern = *pattern_of(fs::path(path).filename().string());
  std::map<std::uint64_t, std::string> found;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (const auto number = pattern.number_in(name)) found[*number] = (folder / name).string();
  }
  if (error)
    throw vp::InputError("the folder of '" + path + "' cannot be read: " + error.message());
  if (found.empty())
    throw vp::InputError("there is no image named like '" + path + "', " +
                         (folder / pattern.name(0)).string() + " for example");
  ImageSequence sequence;
  std::uint64_t next = found.begin()->first;
  for (const auto& [number, file] : found) {
    if (number != next && sequence.gap.empty())
      sequence.gap = (folder / pattern.name(next)).string();
    next = number + 1;
    sequence.files.push_back(file);
  }
  return sequence;
}

}  // namespace platform::input
