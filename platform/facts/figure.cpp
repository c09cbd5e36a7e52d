#include <facts/figure.h>

#include <utility>

namespace platform::facts {

namespace {

/// A file by its folder and name: where the sources lie on the builder's disk says nothing.
std::string short_file(const std::string& path) {
  const std::size_t name = path.rfind('/');
  const std::size_t folder =
      name == std::string::npos || name == 0 ? name : path.rfind('/', name - 1);
  return folder == std::string::npos ? path : path.substr(folder + 1);
}

}  // namespace

const char* to_string(Better better) {
  switch (better) {
    case Better::less:
      return "less";
    case Better::more:
      return "more";
    case Better::neither:
      break;
  }
  return "neither";
}

Figure::Figure(std::string figure_path, std::string figure_unit, std::string figure_meaning,
               Better which_way, std::string head, const char* file, int line)
    : path(std::move(figure_path)),
      unit(std::move(figure_unit)),
      meaning(std::move(figure_meaning)),
      better(which_way),
      title(std::move(head)),
      place(short_file(file) + ":" + std::to_string(line)) {}

Figure Figure::shown_in(std::string unit_for_people, double times) const {
  Figure figure = *this;
  figure.people_unit = std::move(unit_for_people);
  figure.factor = times;
  return figure;
}

Figure Figure::below(const std::string& prefix) const {
  Figure figure = *this;
  if (!prefix.empty()) figure.path = prefix + "." + path;
  return figure;
}

}  // namespace platform::facts
