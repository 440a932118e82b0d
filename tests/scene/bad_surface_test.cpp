/// Every mistake in a scene file gets one line that names file, line, table, key, value and what
/// was expected: surfaces.

#include "scene/mistake.h"

namespace condyle {
namespace {

using test::Mistake;

class BadSurface : public test::MistakeTest {};

TEST_P(BadSurface, IsNamedWithItsPlace) { expect_named(); }

INSTANTIATE_TEST_SUITE_P(
    Surfaces,
    BadSurface,
    testing::Values(
        Mistake{"body = \"femur\"\nkind", "body = \"patella\"\nkind",
                "23: [[surface]] \"ball\": body = \"patella\", expected the name of a body: "
                "\"femur\" or \"tibia\""},
        Mistake{"kind = \"sphere\"", "kind = \"spere\"",
                "24: [[surface]] \"ball\": kind = \"spere\", expected \"patch\", \"plane\", "
                "\"sphere\", \"cylinder\", "
                "\"ellipsoid\", \"torus\" or \"polynomial\"; did you mean \"sphere\"?"},
        Mistake{"radius = 20", "radius = 0",
                "26: [[surface]] \"ball\": radius = 0, expected a radius > 0"},
        Mistake{
            "radius = 20", "radius = \"20\"",
            "26: [[surface]] \"ball\": radius = \"20\", expected a radius > 0, a finite number"},
        Mistake{"radius = 20", "raduis = 20",
                "26: [[surface]] \"ball\": unknown key raduis = 20, did you mean \"radius\"?"},
        Mistake{"radius = 20", "",
                "21: [[surface]] \"ball\": radius is missing, expected a radius > 0"},
        Mistake{"radius = 20", "radius = 20\nsolid = \"in\"",
                "27: [[surface]] \"ball\": solid = \"in\", expected \"inside\" or \"outside\""},
        Mistake{
            "normal = [0, 1, 0]", "normal = [0, 0, 0]",
            "33: [[surface]] \"plateau\": normal = [0, 0, 0], expected a direction of some length"},
        Mistake{"normal = [0, 1, 0]", "normal = [0, 1, 0]\nsolid = \"outside\"",
                "34: [[surface]] \"plateau\": solid = \"outside\", expected \"inside\": a patch or "
                "a plane has no outside"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
            "kind = \"patch\"\ncompartment = \"medial\"",
            "21: [[surface]] \"ball\": no mesh to fit, expected a mesh here or on body \"femur\""},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"torus\"\ncenter = [0, 20, 0]\naxis = [1, 0, 0]\nmajor = 2\nminor = 3",
                "28: [[surface]] \"ball\": minor = 3, expected a radius less than major"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
            "kind = \"polynomial\"\ncoefficients = [[0, 0, 1], [2, -1, 3]]",
            "25: [[surface]] \"ball\": coefficients = -1, expected a whole number from 0 to 20"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"ellipsoid\"\ncenter = [0, 20, 0]\nsemi_axes = [1, 2, 3]\naxes = "
                "[[1,0,0],[0,1,0],[0,0,-1]]",
                "27: [[surface]] \"ball\": axes = [[1, 0, 0], [0, 1, 0], [0, 0, -1]], expected a "
                "right-handed triad"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"ellipsoid\"\ncenter = [0, 20, 0]\nsemi_axes = [6, 8, 1e-8]",
                "26: [[surface]] \"ball\": semi_axes = [6, 8, 1e-08], expected three lengths > 0, "
                "the least no less "
                "than 1e-6 of the greatest"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"polynomial\"\ncoefficients = [[2, 0, -1e308]]",
                "25: [[surface]] \"ball\": coefficients = [2, 0, -1e+308], expected terms [[i, j, "
                "a], ...] of the "
                "height a x^i y^j, |a| below 1e100"}));

// A patch needs a mesh; its file is looked for by read_scene only.
const std::string kSphere = "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20";
INSTANTIATE_TEST_SUITE_P(
    BoundsAndElasticity,
    BadSurface,
    testing::Values(
        Mistake{"normal = [0, 1, 0]", "normal = [0, 1, 0]\nradius = -1",
                "34: [[surface]] \"plateau\": radius = -1, expected a radius of the part that is "
                "known > 0"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]",
                "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]\nlength = 0",
                "27: [[surface]] \"ball\": length = 0, expected a length > 0"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]",
            "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]",
            "38: [[contact]] \"medial\": surfaces = [\"ball\", \"plateau\"], expected bounds of "
            "\"ball\" or of \"plateau\": radius of a plane or a polynomial, length of a "
            "cylinder"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 0",
                "27: [[surface]] \"ball\": modulus = 0, expected a modulus (force/length^2) > 0"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 5\npoisson = 0.5",
                "28: [[surface]] \"ball\": poisson = 0.5, expected Poisson's ratio, at least 0 and "
                "less than 0.5"},
        Mistake{"radius = 20", "radius = 20\nlayer = 3",
                "27: [[surface]] \"ball\": layer = 3, expected a modulus beside it"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 5\nlayer = 0",
                "28: [[surface]] \"ball\": layer = 0, expected a thickness (none: elastic "
                "throughout) > 0"},
        Mistake{
            "radius = 20\n\n[[surface]]\nname = \"plateau\"",
            "radius = 20\nmodulus = 5\nlayer = 2\n\n[[surface]]\nmodulus = 9\nname = "
            "\"plateau\"",
            "40: [[contact]] \"medial\": surfaces = [\"ball\", \"plateau\"], expected layers on "
            "both or on neither (\"ball\" has a layer, \"plateau\" is elastic throughout)"}));

const std::string kPatch = "kind = \"patch\"\nmesh = \"a.stl\"\ncompartment = \"medial\"";
INSTANTIATE_TEST_SUITE_P(
    Patches,
    BadSurface,
    testing::Values(
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\nregion = { box = [[0, 0, 0], [1, 1, 1]], "
                "angles = [0, 90] }",
                "26: [[surface]] \"ball\": region.angles = [0, 90], expected a compartment beside "
                "it"},
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\noffset = -1\nregion = { box = [[0, 0, 0], "
                "[1, 1, 1]] }",
                "26: [[surface]] \"ball\": offset = -1, expected a thickness >= 0"},
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\nregion = { box = [[0, 0, 0], [1, 0, 1]] }",
                "26: [[surface]] \"ball\": region.box = [[0, 0, 0], [1, 0, 1]], expected two "
                "opposite corners "
                "[[x, y, z], [x, y, z]] of a box that encloses some volume"},
        Mistake{kSphere, kPatch + "\nfit = { control_points = [3, 12] }",
                "27: [[surface]] \"ball\": fit.control_points = 3, expected a whole number from 4 "
                "to 500"},
        Mistake{kSphere, kPatch + "\nfit = { smoothing = \"none\" }",
                "27: [[surface]] \"ball\": fit.smoothing = \"none\", expected \"auto\", "
                "\"position\" or a "
                "smoothing length >= 0"},
        Mistake{kSphere, kPatch + "\nmesh_units = \"km\"",
                "27: [[surface]] \"ball\": mesh_units = \"km\", expected \"mm\", \"cm\" or \"m\"; "
                "did you mean \"mm\"?"},
        Mistake{kSphere, "kind = \"patch\"\nmesh = \"a.stl\"",
                "21: [[surface]] \"ball\": compartment is missing, expected \"medial\" or "
                "\"lateral\""}));

}  // namespace
}  // namespace condyle
