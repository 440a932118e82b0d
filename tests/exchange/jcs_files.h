#pragma once

/// Files of a robot's test, made here in the form that Open Knee(s) and KneeHub publish; no number in them
/// was measured.

#include <string>

namespace condyle::test {

inline const std::string kKinematics =
    "Applied Load (Nm),Knee JCS Medial [mm],Knee JCS Posterior [mm],Knee JCS Superior [mm],"
    "Knee JCS Flexion [deg],Knee JCS Valgus [deg],Knee JCS Internal Rotation [deg]\n"
    "0,0.5,1,-2,30.5,0.25,3\n"
    "2.5,0.5,2,-2,30.25,0.5,-4\n"
    "5,0.75,3,-2.5,30,0.75,-9\n";
inline const std::string kKinetics =
    "Applied Load (Nm),JCS Load Lateral Drawer [N],JCS Load Anterior Drawer [N],"
    "JCS Load Distraction [N],JCS Load Extension Torque [Nm],JCS Load Varus Torque [Nm],"
    "JCS Load External Rotation Torque [Nm]\n"
    "0,0,0,-20,0,0,0\n"
    "2.5,1,0,-20,0,0,2.5\n"
    "5,0,0,-20,0,0,5\n";
inline const std::string kState =
    "[Other]\nPosition Offset (m,rad) = \"6 9 9 9 9 9 9\"\n[Knee JCS]\n"
    "Channel Names 0 = \"Medial\"\nChannel Names 1 = \"Posterior\"\n"
    "Channel Names 2 = \"Superior\"\nChannel Names 3 = \"Flexion\"\n"
    "Channel Names 4 = \"Valgus\"\nChannel Names 5 = \"Internal Rotation\"\n"
    "Position Offset (m,rad) = \"6 0.001 -0.002 0.03 0.1 -0.2 0.3\"\n";

}  // namespace condyle::test
