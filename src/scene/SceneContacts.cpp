// The contacts of a scene along the path: points that get their law, and what a state shows of them.
#include <algorithm>
#include <numeric>

#include "machine/Ranks.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

int Scene::numContactPoints() const {
  return std::accumulate(contacts_.begin(), contacts_.end(), 0,
                         [](int n, const ContactPoints& c) { return n + c.count; });
}

bool Scene::contactsGrow() const {
  return std::any_of(contacts_.begin(), contacts_.end(),
                     [](const ContactPoints& contact) { return !contact.near.empty(); });
}

bool Scene::othersAreNear(const path::State& state) const {
  const fem::ConstDofView u = problem_->onRank(state);
  bool near = false;
  for (const ContactPoints& contact : contacts_)
    for (const contact::NearContact* term : contact.near) near = near || term->othersAreNear(u, state.lambda);
  return ranks::any(near);
}

void Scene::grow(const path::State& state) {
  const fem::ConstDofView u = problem_->onRank(state);
  for (const ContactPoints& contact : contacts_)
    for (contact::NearContact* term : contact.near) term->grow(u, state.lambda);
}

int ContactPoints::numCarried() const {
  if (near.empty()) return count;
  return ranks::sum(std::accumulate(near.begin(), near.end(), 0, [](int n, const contact::NearContact* term) {
    return n + term->numCarried();
  }));
}

}  // namespace atrapos
