#include "merge/accounts.hpp"

#include "merge/labels.hpp"

namespace meshgraft {

Accounts::Accounts(Inputs inputs) {
  making_.run([this, inputs] { sums_ = group_sums(inputs); });
  making_.run([this, inputs] { labels_ = labels_of(inputs); });
}

Accounts::~Accounts() noexcept {
  try {
    making_.wait();
  } catch (...) {  // nobody has asked for them
  }
}

const std::vector<std::vector<GroupSum>>& Accounts::sums() {
  making_.wait();
  return sums_;
}

const Labels& Accounts::labels() {
  making_.wait();
  return labels_;
}

}  // namespace meshgraft
