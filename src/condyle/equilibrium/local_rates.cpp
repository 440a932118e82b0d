#include "condyle/equilibrium/local_rates.h"

#include <Eigen/Geometry>

#include <algorithm>

#include "condyle/equilibrium/joint_stiffness.h"

namespace condyle {

LocalRates::LocalRates(const Model& model)
    : lines_(model.elements.size()),
      ends_(model.elements.size()),
      starts_(model.elements.size()),
      wrenches_(model.pairs.size()),
      layers_(model.pairs.size()) {}

void LocalRates::set(const Linearization& at) {
  at_.emplace(at);
  ++stamp_;
}

std::array<double, kMostPathNumbers> LocalRates::kept(std::size_t element) const {
  const std::vector<LineElement>& elements = at_->system.parameters().elements;
  auto numbers = unknown_path();
  if (at_->state.paths.size() != path_numbers(elements)) return numbers;
  const double* from = at_->state.paths.data();
  for (std::size_t i = 0; i < element; ++i)
    if (elements[i].path) from += elements[i].path->numbers();
  std::copy_n(from, elements[element].path->numbers(), numbers.begin());
  return numbers;
}

const LocalRates::Line& LocalRates::line(std::size_t i) {
  Known<Line>& known = lines_[i];
  if (known.at == stamp_) return known.value;
  known.at = stamp_;
  Line& line = known.value;
  const LineElement& element = at_->system.parameters().elements[i];
  const LineEnds ends = ends_of(element, at_->state.X);
  if (element.path) {
    auto numbers = kept(i);
    Wrench unit;
    line.length = element.path->pull(ends, at_->state.X, numbers.data(), unit);
    line.f = unit.f;
    line.m = unit.m;
  } else {
    const Eigen::Vector3d d = ends.x_D - ends.x_C;
    line.length = d.norm();
    line.f = -d / line.length;
    line.m = ends.q.cross(line.f);
  }
  line.tension = tension(element.law, line.length);
  return line;
}

const LineRates* LocalRates::ends(std::size_t i) {
  Known<std::optional<LineRates>>& known = ends_[i];
  if (known.at != stamp_) {
    known.at = stamp_;
    const LineElement& element = at_->system.parameters().elements[i];
    const auto numbers = element.path ? kept(i) : unknown_path();
    if (!end_rates(element, at_->state.X, numbers.data(), known.value.emplace()))
      known.value.reset();
  }
  return known.value ? &*known.value : nullptr;
}

const LocalRates::StartLine& LocalRates::start(std::size_t i) {
  const LineElement& element = at_->system.parameters().elements[i];
  Started& started = starts_[i];
  if (started.known && started.x_C == element.x_C && started.s_D == element.s_D &&
      started.path == element.path)
    return started.line;
  started.x_C = element.x_C;
  started.s_D = element.s_D;
  started.path = element.path;
  started.known = true;
  const RigidTransform& X = at_->model.start;
  auto numbers = unknown_path();
  started.line.length = line_element_state(element, X, numbers.data()).length;
  LineRates rates;
  started.line.knows_ends = end_rates(element, X, numbers.data(), rates);
  started.line.by_C = rates.of_C.length;
  started.line.by_D = X.R.transpose() * rates.of_D.length;
  return started.line;
}

const Wrench& LocalRates::wrench_of_pair(std::size_t pair) {
  Known<Wrench>& known = wrenches_[pair];
  if (known.at == stamp_) return known.value;
  known.at = stamp_;
  known.value = Wrench();
  if (ContactPotential* potential = at_->system.potentials().of(pair))
    potential->add_to(at_->state.X, known.value);
  for (std::size_t k = 0; k < at_->contacts().size(); ++k) {
    const ClosedContact& contact = at_->state.contacts[k];
    if (static_cast<std::size_t>(contact.pair) == pair)
      add_contact_force(at_->contacts()[k], contact.p, known.value);
  }
  return known.value;
}

const ContactRates* LocalRates::layer(std::size_t pair) {
  Known<std::optional<ContactRates>>& known = layers_[pair];
  if (known.at != stamp_) {
    known.at = stamp_;
    ContactPotential* law = at_->system.potentials().of(pair);
    if (law == nullptr || !law->rates(at_->state.X, known.value.emplace())) known.value.reset();
  }
  return known.value ? &*known.value : nullptr;
}

const LocalRates::Matrix6& LocalRates::joint() {
  if (joint_.at != stamp_) {
    joint_.at = stamp_;
    joint_.value = joint_jacobian(*at_->model.joint, at_->state.X);
  }
  return joint_.value;
}

}  // namespace condyle
