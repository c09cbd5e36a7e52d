#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <facts/figure.h>
#include <nlohmann/json.hpp>

namespace platform::result {

using Json = nlohmann::ordered_json;

/// `value` with that many decimal places: what result.json holds. Never -0.
double rounded(double value, int places);

/// A text that is left out while it is empty.
template <class T>
auto unless_empty(std::string T::*text) {
  return [text](const T& value) {
    return (value.*text).empty() ? std::nullopt : std::optional<std::string>(value.*text);
  };
}

/// Null if it is not known.
template <class T>
const T* if_known(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

/// How a value of type T is written to result.json, member for member in order, and which of them
/// are figures. A reader is a function of the value or a pointer to its member; an empty
/// std::optional, or an object without members, is left out. Real numbers are rounded to so many
/// decimal `places`.
template <class T>
class Members {
 public:
  using Write = std::function<void(const T&, Json&)>;

  /// Words, lists and the like: anything but a figure.
  template <class Read>
  Members& text(const std::string& key, Read read) {
    return add(key, std::move(read), 0);
  }

  template <class Read>
  Members& figure(facts::Figure declared, Read read, int places = 0) {
    figures_.push_back(std::move(declared));
    return add(figures_.back().path, std::move(read), places);
  }

  /// An object of figures whose names only the value knows: `read` gets the value and a function
  /// of name and number. `declared` are their paths in it, such as "total" and "*".
  template <class Read>
  Members& named(const std::string& key, const std::vector<facts::Figure>& declared, Read read,
                 int places = 0, bool even_empty = false) {
    for (const facts::Figure& figure : declared) figures_.push_back(figure.below(key));
    writes_.push_back([key, read, places, even_empty](const T& value, Json& json) {
      Json object = Json::object();
      read(value, [&](const std::string& name, auto number) { put(object, name, number, places); });
      if (even_empty || !object.empty()) json[key] = std::move(object);
    });
    return *this;
  }

  /// A list of figures that differ in nothing but their place in it.
  template <class Read>
  Members& numbers(const std::string& key, const facts::Figure& declared, Read read) {
    figures_.push_back(declared.below(key));
    return add(key, std::move(read), 0);
  }

  /// `read` gives a pointer, or an optional, to what `members` are of. `null`: what is absent
  /// is written as null.
  template <class U, class Read>
  Members& object(const std::string& key, const Members<U>& members, Read read, bool null = false) {
    add_figures(members, key);
    writes_.push_back([key, members, read, null](const T& value, Json& json) {
      const auto part = std::invoke(read, value);
      Json object = part ? members.json(*part) : Json();
      if (null || !object.empty()) json[key] = std::move(object);
    });
    return *this;
  }

  /// Members of the same value in an object of their own.
  Members& group(const std::string& key, const Members& members) {
    return object(key, members, [](const T& value) { return &value; });
  }

  /// `read` gives a container.
  template <class U, class Read>
  Members& list(const std::string& key, const Members<U>& members, Read read,
                bool even_empty = true) {
    add_figures(members, key + ".*");
    writes_.push_back([key, members, read, even_empty](const T& value, Json& json) {
      Json array = Json::array();
      for (const U& item : std::invoke(read, value)) array.push_back(members.json(item));
      if (even_empty || !array.empty()) json[key] = std::move(array);
    });
    return *this;
  }

  /// Objects under their names: `read` gets the value and a function of name and item.
  template <class U, class Read>
  Members& each(const Members<U>& members, Read read) {
    add_figures(members, "*");
    writes_.push_back([members, read](const T& value, Json& json) {
      read(value, [&](const std::string& name, const U& item) { json[name] = members.json(item); });
    });
    return *this;
  }

  /// Those of a part, in the same object: `read` as for object().
  template <class U, class Read>
  Members& with(const Members<U>& members, Read read) {
    add_figures(members, "");
    writes_.push_back([members, read](const T& value, Json& json) {
      if (const auto part = std::invoke(read, value)) members.write(*part, json);
    });
    return *this;
  }

  /// What an application or a design adds; it declares its figures itself.
  Members& own(Write write) {
    writes_.push_back(std::move(write));
    return *this;
  }

  void write(const T& value, Json& json) const {
    for (const Write& write : writes_) write(value, json);
  }
  Json json(const T& value) const {
    Json json = Json::object();
    write(value, json);
    return json;
  }
  /// Below the value.
  const std::vector<facts::Figure>& figures() const { return figures_; }

 private:
  template <class Number>
  static void put(Json& json, const std::string& key, const Number& number, int places) {
    if constexpr (std::is_floating_point_v<Number>) {
      json[key] = rounded(number, places);
    } else {
      json[key] = number;
    }
  }
  template <class Number>
  static void put(Json& json, const std::string& key, const std::optional<Number>& number,
                  int places) {
    if (number) put(json, key, *number, places);
  }

  template <class Read>
  Members& add(const std::string& key, Read read, int places) {
    writes_.push_back([key, read, places](const T& value, Json& json) {
      put(json, key, std::invoke(read, value), places);
    });
    return *this;
  }

  template <class U>
  void add_figures(const Members<U>& members, const std::string& prefix) {
    for (const facts::Figure& figure : members.figures()) figures_.push_back(figure.below(prefix));
  }

  std::vector<Write> writes_;
  std::vector<facts::Figure> figures_;
};

}  // namespace platform::result
