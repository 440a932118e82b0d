#pragma once

/// What line elements and contacts know of themselves at one linearization, worked out where it is
/// first asked for: what derivatives with respect to parameters (parameter_effect.h) and those of
/// outputs (pose_output.h) are made of.

#include <vector>

#include "condyle/contact/contact_rates.h"
#include "condyle/elements/end_rates.h"
#include "condyle/equilibrium/linearization.h"

namespace condyle {

class LocalRates {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit LocalRates(const Model& model);

  /// Of that from now on; it is referred to.
  void set(const Linearization& at);
  [[nodiscard]] const Linearization& at() const { return *at_; }

  /// A line element and the wrench of 1 N of it on A.
  struct Line {
    double length = 0;     ///< L [mm]
    Tension tension{};     ///< f and f'
    Eigen::Vector3d f, m;  ///< of 1 N; -∂L/∂(a, π)
  };
  const Line& line(std::size_t element);
  /// Null where its path does not know.
  const LineRates* ends(std::size_t element);

  /// Of the element at the model's start pose [mm], and how that changes with the components of its
  /// ends in the frames of their bodies.
  struct StartLine {
    double length = 0;
    bool knows_ends = false;
    Eigen::Vector3d by_C, by_D;
  };
  const StartLine& start(std::size_t element);

  /// The wrench of one pair on A with its derivatives, of all its points or of its law.
  const Wrench& wrench_of_pair(std::size_t pair);
  /// Null for rigid points, and where nothing is pressed or the law does not know.
  const ContactRates* layer(std::size_t pair);

  /// Of the joint coordinates by (a, π); the model has a joint.
  const Matrix6& joint();

 private:
  /// The numbers of the path of an element at the linearization.
  [[nodiscard]] std::array<double, kMostPathNumbers> kept(std::size_t element) const;

  /// Values of one linearization.
  template <class Value>
  struct Known {
    Value value{};
    int at = -1;  ///< of which: stamp_
  };
  struct Started {
    StartLine line;
    Eigen::Vector3d x_C, s_D;
    std::shared_ptr<const LinePath> path;
    bool known = false;
  };

  std::optional<Linearization> at_;
  int stamp_ = 0;
  std::vector<Known<Line>> lines_;
  std::vector<Known<std::optional<LineRates>>> ends_;
  std::vector<Started> starts_;
  std::vector<Known<Wrench>> wrenches_;
  std::vector<Known<std::optional<ContactRates>>> layers_;
  Known<Matrix6> joint_;
};

}  // namespace condyle
