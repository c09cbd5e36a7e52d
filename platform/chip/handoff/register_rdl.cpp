#include <chip/handoff/described_register.h>
#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

// SystemRDL 2.0, as register tools read and write it: addrmap, regfile, reg and field with arrays,
// addresses, resets, defaults and access. Parameters, Verilog macros and embedded Perl are refused.
namespace platform::handoff {

namespace {

struct Token {
  std::string text;
  unsigned line = 0;
};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '\'' || c == '.';
}

std::vector<Token> tokens_of(const std::string& text, const std::string& origin) {
  std::vector<Token> list;
  unsigned line = 1;
  std::size_t at = 0;
  const auto skip_to = [&](const char* end, const char* what) {
    const std::size_t found = text.find(end, at + 1);
    const unsigned begin = line;
    const std::size_t stop = std::min(found, text.size());
    line +=
        static_cast<unsigned>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                         text.begin() + static_cast<std::ptrdiff_t>(stop), '\n'));
    if (found == text.npos && *end != '\n')
      throw vp::InputError(origin + ":" + std::to_string(begin) + ": " + what +
                           " that does not end");
    return stop;
  };
  while (at < text.size()) {
    if (text[at] == '\n') ++line;
    if (std::isspace(static_cast<unsigned char>(text[at]))) {
      ++at;
    } else if (text.compare(at, 2, "//") == 0) {
      at = skip_to("\n", "a comment");
    } else if (text.compare(at, 2, "/*") == 0) {
      at = skip_to("*/", "a comment") + 2;
    } else if (text[at] == '"') {
      const unsigned begin = line;
      const std::size_t first = at + 1;
      std::size_t end = skip_to("\"", "a text");
      while (text[end - 1] == '\\') {
        at = end;
        end = skip_to("\"", "a text");
      }
      list.push_back({"\"" + text.substr(first, end - first), begin});
      at = end + 1;
    } else if (text[at] == '`' || text.compare(at, 2, "<%") == 0) {
      throw vp::InputError(
          origin + ":" + std::to_string(line) +
          ": a macro or embedded Perl: give the file that a register tool makes of it");
    } else if (is_word(text[at])) {
      const std::size_t first = at;
      while (at < text.size() && is_word(text[at])) ++at;
      list.push_back({text.substr(first, at - first), line});
    } else {
      const bool pair = text.compare(at, 2, "+=") == 0 || text.compare(at, 2, "%=") == 0 ||
                        text.compare(at, 2, "->") == 0;
      list.push_back({text.substr(at, pair ? 2 : 1), line});
      at += pair ? 2 : 1;
    }
  }
  list.push_back({"", line});
  return list;
}

using Properties = std::map<std::string, Token>;

struct Component;

/// A component in its place.
struct Instance {
  std::shared_ptr<const Component> of;
  Token name;
  Token count, high, low, reset, address, stride, alignment;  ///< "" where nothing is said
  Properties own = {};                                        ///< name->property = value
};

struct Component {
  std::string kind;
  Properties properties;
  std::vector<Instance> parts;
};

class Parser {
 public:
  Parser(const std::string& text, std::string origin)
      : origin_(std::move(origin)), tokens_(tokens_of(text, origin_)) {}

  /// The address map of the file: the last one.
  std::shared_ptr<Component> read() {
    auto file = std::make_shared<Component>();
    scopes_.emplace_back();
    while (!now().text.empty()) read_item(*file);
    if (!top_) throw vp::InputError(origin_ + ": no addrmap in it");
    return top_;
  }
  std::string place(const Token& token) const { return origin_ + ":" + std::to_string(token.line); }
  [[noreturn]] void fail(const Token& token, const std::string& why) const {
    throw vp::InputError(place(token) + ": " + why);
  }

 private:
  const Token& now() const { return tokens_[at_]; }
  Token next() {
    if (now().text.empty()) fail(now(), "the file ends inside of a component");
    return tokens_[at_++];
  }
  bool take(const char* text) {
    if (now().text != text) return false;
    ++at_;
    return true;
  }
  void expect(const char* text) {
    if (!take(text))
      fail(now(), "'" + vp::excerpt(vp::visible(now().text)) + "' where '" + text + "' belongs");
  }

  void read_item(Component& in) {
    static const std::set<std::string> kinds{"addrmap", "regfile", "reg", "field"};
    static const std::set<std::string> skipped{"enum",       "signal", "property",
                                               "constraint", "struct", "mem"};
    while (take("external") || take("internal")) continue;
    if (take(";")) return;
    if (kinds.count(now().text) != 0) return read_component(in);
    if (skipped.count(now().text) != 0) return skip();
    if (take("default")) return read_property(defaults_.back());
    const std::string& behind = tokens_[std::min(at_ + 1, tokens_.size() - 1)].text;
    if (behind == "->") return read_property_of_part(in);
    const auto type = known(now().text);
    if (type) {
      next();
      return read_instances(in, type);
    }
    read_property(in.properties);
  }

  /// A component that holds no registers of its own.
  void skip() {
    const Token start = next();
    while (now().text != "{" && now().text != ";") next();
    if (take("{")) {
      for (unsigned depth = 1; depth != 0;) {
        const std::string text = next().text;
        depth += text == "{" ? 1 : text == "}" ? -1 : 0;
      }
    }
    while (!take(";")) next();
  }

  std::shared_ptr<Component> known(const std::string& name) const {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
      const auto found = scope->find(name);
      if (found != scope->end()) return found->second;
    }
    return nullptr;
  }

  void read_component(Component& in) {
    constexpr std::size_t deepest = 64;
    auto component = std::make_shared<Component>();
    const Token kind = next();
    component->kind = kind.text;
    Token name;
    if (now().text != "{") name = next();
    if (now().text == "#") fail(now(), "a component with parameters: they are not read");
    expect("{");
    if (scopes_.size() > deepest) fail(kind, "components that lie too deep in each other");
    scopes_.emplace_back();
    defaults_.push_back(defaults_.back());
    component->properties = defaults_.back();
    while (!take("}")) read_item(*component);
    scopes_.pop_back();
    defaults_.pop_back();
    if (!name.text.empty()) scopes_.back()[name.text] = component;
    if (kind.text == "addrmap" && scopes_.size() == 1) top_ = component;
    while (take("external") || take("internal")) continue;
    if (!take(";")) read_instances(in, component);
  }

  void read_instances(Component& in, const std::shared_ptr<Component>& of) {
    do {
      Instance one{of, next(), {}, {}, {}, {}, {}, {}, {}};
      while (take("[")) {
        const Token first = next();
        if (take(":")) {
          one.high = first;
          one.low = next();
        } else if (one.count.text.empty()) {
          one.count = first;
        } else {
          fail(first, "an array of several dimensions: they are not read");
        }
        expect("]");
      }
      if (take("=")) one.reset = next();
      if (take("@")) one.address = next();
      if (take("+=")) one.stride = next();
      if (take("%=")) one.alignment = next();
      in.parts.push_back(std::move(one));
    } while (take(","));
    expect(";");
  }

  void read_property(Properties& into) {
    const Token name = next();
    if (!is_word(name.text.front()))
      fail(name, "'" + vp::excerpt(vp::visible(name.text)) + "' is no property and no component");
    Token value{"true", name.line};
    if (take("=")) {
      value = next();
      while (now().text != ";") next();  // an expression: of what is read, none has one
    }
    expect(";");
    into[name.text] = value;
  }

  void read_property_of_part(Component& in) {
    const Token name = next();
    expect("->");
    const auto part = std::find_if(in.parts.rbegin(), in.parts.rend(),
                                   [&](const Instance& one) { return one.name.text == name.text; });
    if (part == in.parts.rend()) fail(name, "no '" + vp::excerpt(name.text) + "' lies here");
    read_property(part->own);
  }

  const std::string origin_;
  const std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::vector<std::map<std::string, std::shared_ptr<Component>>> scopes_;
  std::vector<Properties> defaults_{1};
  std::shared_ptr<Component> top_;
};

/// Lays components out in addresses.
class Layout {
 public:
  explicit Layout(const Parser& parser) : parser_(parser) {}

  RegisterMap of(const Component& top) {
    RegisterMap map;
    place(map, top, "", 0);
    return map;
  }

 private:
  std::uint64_t number(const Token& token, std::uint64_t otherwise) const {
    return token.text.empty() ? otherwise : register_number(token.text, parser_.place(token));
  }
  static Token property(const Instance& one, const char* name) {
    const auto own = one.own.find(name);
    if (own != one.own.end()) return own->second;
    const auto found = one.of->properties.find(name);
    return found == one.of->properties.end() ? Token{} : found->second;
  }
  static bool says(const Instance& one, const char* name) {
    return property(one, name).text == "true";
  }
  static std::string text(const Instance& one) {
    Token found = property(one, "desc");
    if (found.text.empty()) found = property(one, "name");
    return found.text.empty() ? "" : vp::visible(std::string(vp::trim(found.text.substr(1))));
  }

  /// Returns the first address behind it.
  std::uint64_t place(RegisterMap& map, const Component& in, const std::string& prefix,
                      std::uint64_t base) {
    std::uint64_t free = 0;
    for (const Instance& one : in.parts) {
      if (one.of->kind == "field") parser_.fail(one.name, "a field outside of a register");
      if (++placed_ > most_registers) parser_.fail(one.name, "too many components");
      const std::uint64_t bytes = size_of(one);
      const std::uint64_t align = number(
          one.alignment, number(property(one, "alignment"), std::min<std::uint64_t>(bytes, 8)));
      const std::uint64_t stride = number(one.stride, bytes);
      if (one.address.text.empty() && align > 1) free = (free + align - 1) / align * align;
      const std::uint64_t first = number(one.address, free);
      const std::uint64_t count = number(one.count, 1);
      if (count > most_registers)
        parser_.fail(one.count, "an array of more than " + std::to_string(most_registers));
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::string index = one.count.text.empty() ? "" : "[" + std::to_string(i) + "]";
        const std::string name = prefix + one.name.text + index;
        const std::uint64_t at = base + first + i * stride;
        if (one.of->kind == "reg") {
          add(map, one, name, at);
        } else {
          place(map, *one.of, name + "_", at);
        }
      }
      if (count != 0) free = std::max(free, first + (count - 1) * stride + bytes);
    }
    return free;
  }

  std::uint64_t size_of(const Instance& one) {
    constexpr std::uint64_t word = 4;
    if (one.of->kind == "reg") return (number(property(one, "regwidth"), 32) + 7) / 8;
    const auto known = sizes_.find(one.of.get());
    if (known != sizes_.end()) return known->second;
    RegisterMap ignored;
    const std::uint64_t end = place(ignored, *one.of, "", 0);
    return sizes_[one.of.get()] = std::max(word, (end + word - 1) / word * word);
  }

  void add(RegisterMap& map, const Instance& one, const std::string& name, std::uint64_t offset) {
    DescribedRegister found;
    found.name = name;
    found.offset = offset;
    found.bits =
        static_cast<unsigned>(std::min<std::uint64_t>(number(property(one, "regwidth"), 32), 1024));
    found.documentation = text(one);
    unsigned free = 0;
    for (const Instance& field : one.of->parts) {
      if (field.of->kind != "field")
        parser_.fail(field.name, "a " + field.of->kind + " in a register");
      add_field(found, field, free);
    }
    const auto only = [&found](const char* access) {
      return std::all_of(found.fields.begin(), found.fields.end(),
                         [&](const auto& field) { return field.access == access; });
    };
    if (!found.fields.empty()) found.access = only("ro") ? "ro" : only("wo") ? "wo" : "rw";
    add_register(map, std::move(found), parser_.place(one.name));
  }

  void add_field(DescribedRegister& in, const Instance& one, unsigned& free) const {
    DescribedRegister::Field field;
    field.name = one.name.text;
    std::uint64_t low = free, bits = number(one.count, number(property(one, "fieldwidth"), 1));
    if (!one.high.text.empty()) {
      const std::uint64_t a = number(one.high, 0), b = number(one.low, 0);
      low = std::min(a, b);
      bits = std::max(a, b) - low + 1;
    }
    constexpr std::uint64_t most = 1024;
    field.low = static_cast<unsigned>(std::min(low, most));
    field.bits = static_cast<unsigned>(std::min(bits, most));
    free = field.low + field.bits;
    field.reset = number(one.reset, number(property(one, "reset"), 0));
    if (field.low < 64) in.reset |= field.reset << field.low;
    field.access = access_of(one);
    field.documentation = text(one);
    const std::string read = property(one, "onread").text;
    if (says(one, "rclr") || read == "rclr")
      field.documentation +=
          field.documentation.empty() ? "cleared by reading" : "; cleared by reading";
    if (field.access != "na") in.fields.push_back(std::move(field));
  }

  static std::string access_of(const Instance& one) {
    const std::string software = property(one, "sw").text, written = property(one, "onwrite").text;
    if (software == "na") return "na";
    if (says(one, "woclr") || written == "woclr") return "w1c";
    if (says(one, "woset") || written == "woset") return "w1s";
    if (written == "wot") return "w1t";
    return software == "r" ? "ro" : software == "w" || software == "w1" ? "wo" : "rw";
  }

  const Parser& parser_;
  std::size_t placed_ = 0;
  std::map<const Component*, std::uint64_t> sizes_;
};

}  // namespace

std::vector<RegisterMap> registers_of_rdl(const std::string& text, const std::string& origin) {
  Parser parser(text, origin);
  const std::shared_ptr<Component> top = parser.read();
  return {Layout(parser).of(*top)};
}

}  // namespace platform::handoff
