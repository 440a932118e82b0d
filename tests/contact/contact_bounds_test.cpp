#include <gtest/gtest.h>

#include <cstdlib>

#include "condyle/contact/contact.h"
#include "support/bumpy_patches.h"

namespace condyle::test {
namespace {

/// Lowers A until it first touches: the lowest gap vanishes.
void bring_together(BruteForce& brute, RigidTransform& X) {
  for (int step = 0; step < 6; ++step) {
    const std::vector<GapMinimum> minima = brute.minima(X, 100);
    if (minima.empty()) return;
    X.p -= minima.front().gap * minima.front().n;
    if (std::abs(minima.front().gap) < 1e-3) return;
  }
}

KnownContact contact_at(const ContactPair& pair,
                        const GapMinimum& minimum,
                        const RigidTransform& X) {
  return known_contact(linearize_contact(pair, minimum.places, X));
}

struct Count {
  int poses = 0, minima = 0, missed = 0;
  double deepest_missed = 0;
};

/// Every minimum that brute force finds below -1e-6 mm has to be among those found.
void compare(const std::vector<GapMinimum>& truth,
             const std::vector<GapMinimum>& found,
             Count& count) {
  for (const GapMinimum& minimum : truth) {
    ++count.minima;
    const bool seen = std::any_of(found.begin(), found.end(), [&](const GapMinimum& f) {
      return (f.point_B - minimum.point_B).norm() < 0.3 && f.gap < minimum.gap + 1e-7;
    });
    if (seen) continue;
    ++count.missed;
    count.deepest_missed = std::min(count.deepest_missed, minimum.gap);
  }
}

/// Poses of one pair in which its lowest minima touch: half of them with one of these given as a
/// contact that has been solved, the others a little apart or inside.
void try_pair(Random& random, int poses, Count& count) {
  const ContactPair pair = bumpy_pair(random, random.between(0.05, 0.5));
  ContactSearch search(pair);
  BruteForce brute(pair, 0.5);
  for (int k = 0; k < poses; ++k) {
    RigidTransform X = bumpy_pose(random);
    bring_together(brute, X);
    const std::vector<GapMinimum> near = brute.minima(X, 0.2);
    if (near.empty()) continue;
    const std::size_t pick =
        std::min(near.size() - 1, static_cast<std::size_t>(random.between(0, 4)));
    X.p -= near[pick].gap * near[pick].n;
    std::vector<KnownContact> known;
    if (random.between(0, 1) < 0.5)
      known.push_back(contact_at(pair, near[pick], X));
    else
      X.p += random.between(-0.02, 0.005) * near.front().n;
    std::vector<GapMinimum> found;
    search.find(X, 0, found, 0.3, known);
    compare(brute.minima(X, -1e-6), found, count);
    ++count.poses;
  }
}

// The bounds of the search are those of the surfaces: on bumpy patches (0.05 to 0.5 mm in waves of
// 5 to 16 mm) no overlap hides beside a contact that is known, nor between samples.
TEST(ContactBounds, NoMinimumOfBumpyPatchesIsMissed) {
  const char* asked = std::getenv("CONDYLE_BUMPY_POSES");
  const int poses = asked ? std::atoi(asked) : 1000;
  Random random(7);
  Count count;
  while (count.poses < poses) try_pair(random, 20, count);
  RecordProperty("minima", count.minima);
  EXPECT_EQ(count.missed, 0) << "of " << count.minima << " minima in " << count.poses
                             << " poses; the deepest " << count.deepest_missed << " mm";
  EXPECT_GT(count.minima, poses / 3);
}

}  // namespace
}  // namespace condyle::test
