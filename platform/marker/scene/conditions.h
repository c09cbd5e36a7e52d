#pragma once

#include <string>
#include <vector>

#include <marker/scene/scene.h>

namespace platform {

/// Squares in the last picture of thesis 5.2.4, the marker included.
constexpr int most_squares = 15;

/// Those around the marker in the picture with `count` squares in all, 1 to 15 (thesis 5.2.4).
std::vector<Square> squares_around(int count);

/// Changes a scene by "distance=2m,roll=30deg,noise=0.02,…":
///
///   distance               of the marker's centre, on the camera's axis
///   pitch, yaw, roll       angles of the marker: Rx(pitch) * Ry(yaw) * Rz(roll)
///   noise                  deviation, fraction of full scale
///   blur                   deviation, px
///   light                  factor of all brightness
///   squares                the marker and plain ones around it, 1 to 15
///   markers                the marker and others around it, 1 to 15, whose IDs count on from its
///   id                     of the marker
///   velocity_x, velocity_y, velocity_z   of marker and room as the camera sees them, m/s
///   spin                   about the marker's centre and the camera's axis, degrees/s
///   time                   of the picture: where that motion has led from the scene's pose
///   exposure               time for which a row gathers light: the motion's blur
///   readout                time from the first row's exposure to the last's: a rolling shutter
///   vignetting             share of the light that is missing in the farthest corner
///   response               what light grey levels stand for: srgb, rec709 or an exponent
///   hidden                 radius of a disc over the marker's top left corner, share of its side
///   jpeg                   quality of the file that the picture was in, 1 to 100
///
/// One of the first four places the marker anew; those of them that are not given are 1 m and 0.
/// Throws vp::InputError for what is not one, and for a scene that cannot be rendered then.
void set_conditions(Scene& scene, const std::string& conditions);

}  // namespace platform
