#include "condyle/equilibrium/model_covers.h"

#include <algorithm>
#include <stdexcept>

#include "condyle/contact/contact_scales.h"

namespace condyle {

ContactCovers cover_pairs(const Model& model) {
  ContactCovers covers;
  covers.reserve(model.pairs.size());
  for (const ContactPair& pair : model.pairs)
    covers.push_back(std::make_shared<const ContactCover>(pair, kSampleSpacing * model.length));
  return covers;
}

std::vector<ContactSearch> make_searches(const Model& model, const ContactCovers& covers) {
  const bool of_model =
      std::equal(covers.begin(), covers.end(), model.pairs.begin(), model.pairs.end(),
                 [](const std::shared_ptr<const ContactCover>& cover, const ContactPair& pair) {
                   return cover && cover->surface_B == pair.on_B && cover->surface_A == pair.on_A;
                 });
  if (!of_model) throw std::invalid_argument("the covers are not of the surfaces of this model");
  return {covers.begin(), covers.end()};
}

}  // namespace condyle
