#include <facts/unit.h>

#include <algorithm>
#include <cctype>

namespace platform::facts {

const std::vector<std::uint8_t>& UnitInput::bytes() const {
  static const std::vector<std::uint8_t> nothing;
  return nothing;
}

std::string Work::counted(std::uint64_t count) const {
  const bool delivers = !unit.empty();
  const std::string one = delivers ? unit : "run";
  return std::to_string(count) + " " + (count == 1 ? one : delivers ? many() : "runs");
}

namespace {

/// "peak_level" → "Peak level".
std::string heading(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

}  // namespace

std::vector<Figure> Work::declared() const {
  std::vector<Figure> all;
  for (const Tally& tally : tallies) {
    if (tally.is_figure)
      all.push_back({"summary." + tally.name, "1", many() + " " + tally.with, tally.better,
                     heading(many() + " " + tally.with)});
  }
  for (const Figure& figure : figures) {
    all.push_back(figure.below("frames.figures"));
    if (figure.title.empty()) all.back().title = heading(figure.path);
  }
  return all;
}

}  // namespace platform::facts
