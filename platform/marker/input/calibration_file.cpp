#include <expat.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include <marker/input/calibration_dialect.h>
#include <marker/input/calibration_file.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/yaml.h>

// OpenCV's own parser is for files that one trusts: it overruns the stack on short ones.

namespace platform::input {

namespace {

/// Calibration files have a few hundred lines; anything larger is something else.
constexpr std::uintmax_t largest_file = 1 << 20;

/// What YAML, JSON and XML have in common.
struct Node {
  enum class Kind { text, list, map };

  std::string name;  ///< its key or tag; empty for an element of a list
  Kind kind = Kind::text;
  std::string text;            ///< of `text`
  bool is_binary = false;      ///< the text is base64
  std::vector<Node> children;  ///< of lists and maps

  const Node* find(const char* child) const {
    for (const Node& node : children)
      if (node.name == child) return &node;
    return nullptr;
  }
};

/// Reads a whole word; OpenCV and YAML write ".Nan" and "-.Inf".
std::optional<double> number(std::string_view word) {
  const bool has_plus = !word.empty() && word.front() == '+';
  const bool is_negative = !word.empty() && word.front() == '-';
  std::string text = vp::lower(std::string(word.substr(has_plus || is_negative ? 1 : 0)));
  if (text == ".nan" || text == ".inf") text.erase(0, 1);
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  if (!text.empty() && text.front() == '-') return std::nullopt;
  return is_negative ? -value : value;
}

/// OpenCV's --base64: 24 bytes that name the type, then the elements as a PC has them in memory.
std::optional<std::vector<double>> unpacked(const std::string& base64) {
  constexpr std::size_t head = 24;
  const std::vector<unsigned char> bytes = YAML::DecodeBase64(base64);
  if (bytes.size() < head) return std::nullopt;
  const std::string type(vp::trim({reinterpret_cast<const char*>(bytes.data()), head}));
  const auto elements = [&](auto element) {
    std::vector<double> values;
    for (std::size_t at = head; at + sizeof element <= bytes.size(); at += sizeof element) {
      std::memcpy(&element, bytes.data() + at, sizeof element);
      values.push_back(static_cast<double>(element));
    }
    return values;
  };
  switch (type.empty() ? ' ' : type.back()) {
    case 'd':
      return elements(double());
    case 'f':
      return elements(float());
    case 'i':
      return elements(std::int32_t());
    default:
      return std::nullopt;
  }
}

/// The words of a node; an empty one, which is no number, for a map inside a list.
void add_words(const Node& node, std::vector<std::string>& words) {
  if (node.kind == Node::Kind::map) words.emplace_back();
  if (node.kind == Node::Kind::list)
    for (const Node& child : node.children) add_words(child, words);
  if (node.kind != Node::Kind::text) return;
  std::string text = node.text;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return std::isspace(c & 0xff) != 0; }, ' ');
  for (std::string& word : vp::split(text, ' '))
    if (!word.empty()) words.push_back(std::move(word));
}

/// Empty unless all of it is numbers.
std::vector<double> numbers_of(const Node& node, bool is_binary) {
  std::vector<std::string> words;
  add_words(node, words);
  if (is_binary) return unpacked(vp::join(words, "")).value_or(std::vector<double>());
  std::vector<double> values;
  for (const std::string& word : words) {
    const auto value = number(word);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

/// Makes entries of a tree.
class Collection {
 public:
  explicit Collection(std::string what) : what_(std::move(what)) {}

  void add(const Node& node, const std::string& name) {
    if (node.kind == Node::Kind::map) {
      if (const Node* data = node.find("data")) return add_matrix(node, *data, name);
      return add_children(node, name);
    }
    CalibrationEntry entry;
    entry.name = name;
    entry.numbers = numbers_of(node, node.is_binary);
    entry.is_list = node.kind == Node::Kind::list;
    entry.text = entry.is_list ? text_in_place_of(entry, node) : node.text;
    entries_.push_back(std::move(entry));
    if (node.kind == Node::Kind::list) add_children(node, name);
  }

  /// The maps among the children: of a list they have its name.
  void add_children(const Node& node, const std::string& name) {
    const std::string prefix = name.empty() ? "" : name + ".";
    for (const Node& child : node.children) {
      if (node.kind == Node::Kind::map) {
        add(child, prefix + child.name);
      } else if (child.kind != Node::Kind::text) {
        add_nested(child, name);
      }
    }
  }

  std::vector<CalibrationEntry> take() { return std::move(entries_); }

 private:
  void add_nested(const Node& node, const std::string& name) {
    if (node.kind == Node::Kind::map) return add(node, name);
    for (const Node& child : node.children) add_nested(child, name);
  }

  void add_matrix(const Node& node, const Node& data, const std::string& name) {
    const auto text = [&node](const char* child) {
      const Node* found = node.find(child);
      return found ? found->text : std::string();
    };
    const auto sides = [](const std::string& side) {
      const double value = number(side).value_or(0);
      return value >= 1 && value <= static_cast<double>(largest_file)
                 ? static_cast<std::size_t>(value)
                 : 0;
    };
    CalibrationEntry entry;
    entry.name = name;
    entry.is_list = true;
    entry.numbers = numbers_of(data, node.is_binary || data.is_binary);
    entry.rows = sides(text("rows"));
    entry.columns = sides(text("cols"));
    const std::string type = text("dt");
    if (!type.empty() && type.back() == 'f')
      for (double& value : entry.numbers) value = static_cast<float>(value);
    const double channels = type.empty() ? 1 : number(type.substr(0, type.size() - 1)).value_or(1);
    const auto count = static_cast<double>(entry.rows * entry.columns) * channels;
    if (count > 0 && !entry.numbers.empty() && count != static_cast<double>(entry.numbers.size())) {
      throw vp::InputError(
          what_ + ", '" + vp::excerpt(name) +
          "': its data are not rows times cols numbers: " + std::to_string(entry.numbers.size()) +
          ", not " + std::to_string(entry.rows) + "x" + std::to_string(entry.columns));
    }
    entry.text = text_in_place_of(entry, data);
    entries_.push_back(std::move(entry));
  }

  /// Of a list or a matrix that is not numbers; it is not an empty one.
  static std::string text_in_place_of(const CalibrationEntry& entry, const Node& node) {
    std::vector<std::string> words;
    add_words(node, words);
    return entry.numbers.empty() ? vp::join(words, " ") : "";
  }

  std::string what_;
  std::vector<CalibrationEntry> entries_;
};

// ---- YAML and JSON ----

Node node_of(const YAML::Node& yaml, std::string name) {
  constexpr std::string_view base64_mark = "$base64$";
  Node node;
  node.name = std::move(name);
  if (yaml.IsMap()) {
    node.kind = Node::Kind::map;
    for (const auto& entry : yaml) {
      if (entry.first.IsScalar())
        node.children.push_back(node_of(entry.second, entry.first.Scalar()));
    }
  } else if (yaml.IsSequence()) {
    node.kind = Node::Kind::list;
    for (const YAML::Node& element : yaml) node.children.push_back(node_of(element, ""));
  } else if (yaml.IsScalar()) {
    node.text = yaml.Scalar();
    node.is_binary = yaml.Tag() == "tag:yaml.org,2002:binary";
    if (node.text.rfind(base64_mark, 0) == 0) {
      node.text.erase(0, base64_mark.size());
      node.is_binary = true;
    }
  }
  return node;
}

/// OpenCV writes comments into its JSON as C++ has them: turned into blanks.
std::string without_comments(std::string json) {
  bool in_text = false;
  for (std::size_t i = 0; i + 1 < json.size(); ++i) {
    if (in_text && json[i] == '\\') {
      ++i;
    } else if (json[i] == '"') {
      in_text = !in_text;
    } else if (!in_text && json[i] == '/' && json[i + 1] == '/') {
      for (; i < json.size() && json[i] != '\n'; ++i) json[i] = ' ';
    }
  }
  return json;
}

Node read_yaml(const std::string& text, const std::string& what) {
  // JSON is YAML, but for its comments.
  const bool is_json = text.rfind('{', 0) == 0;
  const YAML::Node root =
      vp::load_yaml(is_json ? without_comments(text) : text, what, vp::YamlDocuments::first);
  if (!root.IsMap()) throw vp::InputError(what + ": no entries in YAML, XML or JSON");
  return node_of(root, "");
}

// ---- XML ----

/// <opencv_storage> <name> words </name> <name type_id="opencv-matrix"> <rows/> <cols/> <dt/>
/// <data> words </data> </name> </opencv_storage>; the elements of a list are <_>.
class XmlReader {
 public:
  explicit XmlReader(const std::string& what)
      : what_(what), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {}

  Node read(const std::string& text) {
    XML_Parser parser = parser_.get();
    if (parser == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &XmlReader::start, &XmlReader::end);
    XML_SetCharacterDataHandler(parser, &XmlReader::characters);
    // No such file has one, and entities are defined in it.
    XML_SetStartDoctypeDeclHandler(parser, &XmlReader::doctype);
    const auto status = XML_Parse(parser, text.data(), static_cast<int>(text.size()), XML_TRUE);
    if (error_) std::rethrow_exception(error_);
    if (status != XML_STATUS_OK) fail("this is not whole XML: write it anew, or correct it");
    return std::move(root_);
  }

 private:
  static constexpr std::size_t deepest = 32;

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(what_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get())) +
                         ":" + std::to_string(XML_GetCurrentColumnNumber(parser_.get()) + 1) +
                         ": " + problem);
  }

  /// No exception may pass through the library.
  template <class Work>
  static void guarded(void* self, Work work) {
    auto& reader = *static_cast<XmlReader*>(self);
    if (reader.error_) return;
    try {
      work(reader);
    } catch (...) {
      reader.error_ = std::current_exception();
      XML_StopParser(reader.parser_.get(), XML_FALSE);
    }
  }

  static void start(void* self, const XML_Char* name, const XML_Char** attributes) {
    guarded(self, [&](XmlReader& reader) { reader.open(name, attributes); });
  }
  static void end(void* self, const XML_Char*) {
    guarded(self, [](XmlReader& reader) { reader.close(); });
  }
  static void characters(void* self, const XML_Char* text, int size) {
    guarded(self, [&](XmlReader& reader) {
      reader.add_text({text, static_cast<std::size_t>(size)});
    });
  }
  static void doctype(void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    guarded(self,
            [](XmlReader& reader) { reader.fail("OpenCV's XML has no DOCTYPE: leave it out"); });
  }

  void open(const std::string& name, const XML_Char** attributes) {
    if (open_.empty() && name != "opencv_storage") {
      fail("no <opencv_storage>: not OpenCV's XML, and no other XML is read");
    }
    if (open_.size() == deepest)
      fail("nested more than " + std::to_string(deepest) + " levels deep: write it anew");
    Node node;
    if (name != "_") node.name = name;
    for (; *attributes != nullptr; attributes += 2) {
      if (std::string_view(attributes[0]) == "type_id" &&
          std::string_view(attributes[1]) == "binary")
        node.is_binary = true;
    }
    open_.push_back(std::move(node));
  }

  void add_text(std::string_view text) {
    if (!open_.empty()) open_.back().text += text;
  }

  void close() {
    Node node = std::move(open_.back());
    open_.pop_back();
    node.text = vp::trim(node.text);
    const bool is_quoted =
        node.text.size() > 1 && node.text.front() == '"' && node.text.back() == '"';
    if (is_quoted) node.text = node.text.substr(1, node.text.size() - 2);
    if (open_.empty()) {
      node.kind = Node::Kind::map;
      node.name.clear();
      root_ = std::move(node);
      return;
    }
    Node& parent = open_.back();
    if (parent.kind != Node::Kind::map)
      parent.kind = node.name.empty() ? Node::Kind::list : Node::Kind::map;
    parent.children.push_back(std::move(node));
  }

  const std::string& what_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser_;
  std::exception_ptr error_;
  std::vector<Node> open_;  ///< the elements around, outermost first
  Node root_;
};

// ---- Formats that are not read ----

bool begins(const std::string& text, std::string_view with) {
  return text.compare(0, with.size(), with) == 0;
}

/// What the file is, if its first bytes or its words say that it is not one of ours; else empty.
std::string other_format(const std::string& text) {
  if (begins(text, "MATLAB ")) return "a MAT-file of MATLAB";
  if (begins(text, "\x93NUMPY") || begins(text, "PK\x03\x04"))
    return "an array of NumPy (or a ZIP)";
  if (begins(text, "# Camera list with one line")) return "a camera list of COLMAP";
  return "";
}

}  // namespace

std::string plain_name(const std::string& name) {
  std::string text;
  for (const char c : vp::lower(name))
    if (c != '_' && c != '-' && c != ' ') text += c;
  return text;
}

std::vector<CalibrationEntry> read_file_storage(const std::string& text, const std::string& what) {
  Collection collection(what);
  collection.add_children(text[0] == '<' ? XmlReader(what).read(text) : read_yaml(text, what), "");
  return collection.take();
}

std::vector<CalibrationEntry> read_calibration_file(const std::string& path) {
  std::string text = vp::read_text(path, "camera file", largest_file);
  const std::string what = "camera file '" + path + "'";
  if (begins(text, "\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.empty()) throw vp::InputError(what + " is empty");
  const std::string other = other_format(text);
  if (!other.empty())
    throw vp::InputError(what + " is " + other + ": give " + accepted_calibrations);
  if (text.find('\0') != std::string::npos)
    throw vp::InputError(what + ": no entries in YAML, XML or JSON");
  if (std::optional<std::vector<CalibrationEntry>> script = read_script(text, what))
    return std::move(*script);
  return in_known_words(read_file_storage(text, what), what);
}

}  // namespace platform::input
