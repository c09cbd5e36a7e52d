#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// Where a number comes from. Shown by `markervp config` and in reports.
enum class Source {
  measured,   ///< measured on the thesis' board
  published,  ///< stated by the thesis, a product guide or a data sheet
  derived,    ///< computed from published or measured values
  assumed,    ///< an estimate without a source
  decision,   ///< a choice of this project where the thesis is silent
};

const char* to_string(Source source);

/// A value that a user gave, and where: "platform.yaml:3", "--set".
struct Setting {
  std::string text;
  std::string origin;
  bool is_list = false;  ///< a list of maps, in one line
};

/// What the configuration remembers of a parameter after the platform is gone.
struct ParameterDescription {
  std::string path;           ///< hierarchical name
  std::string value;          ///< effective value with its unit
  std::string default_value;  ///< with its unit
  std::string allowed;        ///< "1 MHz to 1 GHz", "clocked or tlm"; may be empty
  Source source = Source::decision;
  std::string documentation;  ///< one line
  std::string follows = {};   ///< what its default is computed from: "ps.cpu_clk.frequency"
};

/// The values a user set, over the defaults that stand beside the parameters in code.
///
/// Later files win over earlier ones and `set` over all files, whatever the order of the calls.
/// While a platform is built inside a Scope, each vp::Parameter looks up its full name here and
/// registers itself; check_unused() then finds the unused keys. All failures are vp::InputError.
class Configuration {
 public:
  /// Reads a YAML file of nested maps or dotted keys; the leaves are scalars.
  void load_file(const std::string& path);
  /// The same for text; messages name `origin` instead of a file.
  void load_text(const std::string& yaml, const std::string& origin);
  /// One `--set` argument, "path=value".
  void set(std::string_view assignment);
  void set(std::string_view path, std::string_view value, std::string_view origin = "--set");

  /// What the user set for `path`; null if nothing.
  const Setting* find(const std::string& path) const;
  /// Called by each parameter when it is built.
  void add(ParameterDescription description);
  /// Called for a parameter whose default is computed from `others`.
  void set_follows(const std::string& path, const std::string& others);

  /// After elaboration: throws if a key was set that no parameter has.
  void check_unused() const;

  /// All parameters built in a scope of this configuration: a module's own first, then its
  /// submodules, in the order of their construction.
  std::vector<ParameterDescription> parameters() const;
  /// The effective tree as YAML that load_text() reads back: value, documentation, source, and
  /// default where changed. A default that follows other parameters is a comment: written as a
  /// value it would no longer follow them.
  std::string to_yaml() const;
  /// The effective tree as {path: "value unit"}.
  std::map<std::string, std::string> values() const;
  /// 64-bit FNV-1a hash of values(), 16 hexadecimal digits.
  std::string hash() const;

  /// The innermost configuration in scope; null if none (parameters then have their defaults).
  static Configuration* current();

  /// Makes a configuration the current one while it lives.
  class Scope {
   public:
    explicit Scope(Configuration& configuration);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Configuration* outer_;
  };

 private:
  using Settings = std::map<std::string, Setting>;

  std::string unknown_key(const std::string& key, const Setting& setting) const;

  Settings from_files_;
  Settings from_command_line_;
  std::vector<ParameterDescription> parameters_;
  std::map<std::string, std::size_t> index_;  ///< path -> position in parameters_
};

}  // namespace vp
