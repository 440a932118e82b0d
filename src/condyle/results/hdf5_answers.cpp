#include "condyle/results/hdf5_answers.h"

#include <memory>
#include <utility>
#include <vector>

namespace condyle {
namespace {

using Groups = std::vector<Hdf5Group>;

Hdf5Answer number(std::uint64_t number) {
  return {.number = number, .texts = {}, .values = {}, .shape = {}};
}

Hdf5Answer texts(std::vector<std::string> texts) {
  return {.texts = std::move(texts), .values = {}, .shape = {}};
}

Hdf5Answer answer(const Hdf5Question& of, Groups& groups) {
  const Hdf5Group& group = groups.at(of.group);
  switch (of.kind) {
    case Hdf5Asked::kOpen: {
      Hdf5Group opened = group.open(of.name);
      groups.push_back(std::move(opened));
      return number(groups.size() - 1);
    }
    case Hdf5Asked::kHas:
      return number(group.has(of.name) ? 1 : 0);
    case Hdf5Asked::kHasAttribute:
      return number(group.has_attribute(of.attribute) ? 1 : 0);
    case Hdf5Asked::kIsGroup:
      return number(group.is_group(of.name) ? 1 : 0);
    case Hdf5Asked::kNames:
      return texts(group.names());
    case Hdf5Asked::kKind:
      return number(static_cast<std::uint64_t>(group.kind(of.name)));
    case Hdf5Asked::kNumbers: {
      Hdf5Array array = group.read(of.name);
      return {.texts = {}, .values = std::move(array.values), .shape = std::move(array.shape)};
    }
    case Hdf5Asked::kTexts:
      return texts(group.read_texts(of.name));
    case Hdf5Asked::kAttribute:
      return texts({group.read_attribute(of.attribute)});
    case Hdf5Asked::kAttributeOf:
      return texts({group.read_attribute(of.name, of.attribute)});
    case Hdf5Asked::kAttributeTexts:
      return texts(group.read_attribute_texts(of.name, of.attribute));
  }
  return {};
}

}  // namespace

Hdf5Process::Answering answers_of(Hdf5Group root) {
  const auto groups = std::make_shared<Groups>();
  groups->push_back(std::move(root));
  return [groups](const Hdf5Question& question) { return answer(question, *groups); };
}

}  // namespace condyle
