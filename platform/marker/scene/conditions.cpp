#include <marker/light_curves.h>
#include <marker/scene/conditions.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

namespace {

class Conditions {
 public:
  explicit Conditions(Scene& scene) : scene_(scene) {}

  void set(const std::string& condition) {
    const std::size_t sign = condition.find('=');
    const std::string key(vp::trim(condition.substr(0, sign)));
    const auto found = keys().find(key);
    if (sign == std::string::npos || found == keys().end()) refuse(key);
    const std::string text(vp::trim(condition.substr(sign + 1)));
    try {
      (this->*found->second)(text);
    } catch (const vp::InputError& error) {
      throw vp::InputError("scene '" + scene_.name + "': " + key + ": '" + text + "' " +
                           error.what());
    }
  }

  /// What several conditions decide together.
  void finish() const {
    if (all_markers_) {
      int id = scene_.marker_id;
      for (Square& square : scene_.squares) square.word = marker_word(++id % dictionary_size);
    }
    if (scene_.motion.any() && !lasts_) {
      throw vp::InputError("scene '" + scene_.name +
                           "': its motion shows in no picture: name the exposure, readout or time "
                           "that it lasts (as in 'z1.0@velocity_x=1,exposure=5ms')");
    }
    if (!placed_) return;
    scene_.pose = pose_from_centre(rotation_x(pitch_) * (rotation_y(yaw_) * rotation_z(roll_)),
                                   {0, 0, distance_});
  }

 private:
  using Setter = void (Conditions::*)(const std::string&);

  static const std::map<std::string, Setter>& keys() {
    static const std::map<std::string, Setter> all{
        {"distance", &Conditions::set_distance},
        {"pitch", &Conditions::set_angle<&Conditions::pitch_>},
        {"yaw", &Conditions::set_angle<&Conditions::yaw_>},
        {"roll", &Conditions::set_angle<&Conditions::roll_>},
        {"noise", &Conditions::set_noise},
        {"blur", &Conditions::set_blur},
        {"light", &Conditions::set_light},
        {"squares", &Conditions::set_squares},
        {"markers", &Conditions::set_markers},
        {"id", &Conditions::set_id},
        {"velocity_x", &Conditions::set_velocity<0>},
        {"velocity_y", &Conditions::set_velocity<1>},
        {"velocity_z", &Conditions::set_velocity<2>},
        {"spin", &Conditions::set_spin},
        {"time", &Conditions::set_time},
        {"exposure", &Conditions::set_exposure},
        {"readout", &Conditions::set_readout},
        {"vignetting", &Conditions::set_vignetting},
        {"response", &Conditions::set_response},
        {"hidden", &Conditions::set_hidden},
        {"jpeg", &Conditions::set_jpeg}};
    return all;
  }

  [[noreturn]] void refuse(const std::string& key) const {
    std::vector<std::string> names;
    for (const auto& [name, unused] : keys()) names.push_back(name);
    const std::string nearest = vp::nearest_match(key, names);
    throw vp::InputError("scene '" + scene_.name + "': '" + key + "' is no condition: " +
                         (nearest.empty() ? "there are " + vp::join(names, ", ")
                                          : "did you mean '" + nearest + "'?") +
                         " (as in 'demo@distance=2m,noise=0.02')");
  }

  static double number(const std::string& text, vp::Unit unit) {
    return vp::parse_quantity(text, unit).to_double();
  }
  static int whole(const std::string& text, int least, int most) {
    const double value = number(text, vp::Unit::none);
    if (value != std::floor(value) || value < least || value > most)
      throw vp::InputError("is no whole number from " + std::to_string(least) + " to " +
                           std::to_string(most));
    return static_cast<int>(value);
  }

  void set_distance(const std::string& text) {
    placed_ = true;
    distance_ = number(text, vp::Unit::length);
  }
  template <double Conditions::*angle>
  void set_angle(const std::string& text) {
    placed_ = true;
    this->*angle = number(text, vp::Unit::angle);
  }
  void set_noise(const std::string& text) { scene_.noise_sigma = number(text, vp::Unit::none); }
  void set_blur(const std::string& text) { scene_.blur_sigma_px = number(text, vp::Unit::pixels); }
  void set_light(const std::string& text) {
    const double factor = number(text, vp::Unit::none);
    Brightness& light = scene_.brightness;
    for (double* level : {&light.black, &light.border, &light.wall, &light.floor, &light.ceiling,
                          &light.side_walls})
      *level *= factor;
  }
  void set_squares(const std::string& text) {
    scene_.squares = squares_around(whole(text, 1, most_squares));
    all_markers_ = false;
  }
  void set_markers(const std::string& text) {
    set_squares(text);
    all_markers_ = true;
  }
  void set_id(const std::string& text) { scene_.marker_id = whole(text, 0, dictionary_size - 1); }

  /// Of a time for which things move.
  double seconds(const std::string& text) {
    constexpr double s_per_ps = 1e-12;
    lasts_ = true;
    return number(text, vp::Unit::time) * s_per_ps;
  }
  template <int axis>
  void set_velocity(const std::string& text) {
    scene_.motion.velocity[axis] = number(text, vp::Unit::none);
  }
  void set_spin(const std::string& text) {
    scene_.motion.spin_deg_per_s = number(text, vp::Unit::none);
  }
  void set_time(const std::string& text) { scene_.time_s = seconds(text); }
  void set_exposure(const std::string& text) { scene_.shutter.exposure_s = seconds(text); }
  void set_readout(const std::string& text) { scene_.shutter.readout_s = seconds(text); }
  void set_vignetting(const std::string& text) { scene_.vignetting = number(text, vp::Unit::none); }

  void set_hidden(const std::string& text) { scene_.hidden = number(text, vp::Unit::none); }
  void set_jpeg(const std::string& text) { scene_.jpeg = whole(text, 1, 100); }
  void set_response(const std::string& text) {
    marker::LightTable light;
    if (text == "srgb") {
      marker::fill_srgb_light(light);
    } else if (text == "rec709") {
      marker::fill_rec709_light(light);
    } else {
      const double exponent = number(text, vp::Unit::none);
      if (!(exponent >= 0.5 && exponent <= 5))
        throw vp::InputError("is neither srgb nor rec709, nor an exponent from 0.5 to 5");
      marker::fill_light(exponent, light);
    }
    scene_.response = text;
    scene_.light_of_levels = std::make_shared<const marker::LightTable>(light);
  }

  Scene& scene_;
  bool placed_ = false, all_markers_ = false, lasts_ = false;
  double distance_ = 1;
  double pitch_ = 0, yaw_ = 0, roll_ = 0;
};

}  // namespace

void set_conditions(Scene& scene, const std::string& conditions) {
  Conditions reader(scene);
  for (const std::string& condition : vp::split(conditions, ',')) reader.set(condition);
  reader.finish();
  validate(scene);
}

}  // namespace platform
