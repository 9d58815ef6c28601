#include "bench/contender.hpp"
#include "bench/icet.hpp"

namespace burin::host::bench {

namespace {

/// One strategy of an IceT that all of them share, with its buffers.
class IceTContender : public Contender {
 public:
  IceTContender(std::shared_ptr<IceT> icet, IceTStrategy strategy)
      : icet_{std::move(icet)}, strategy_{strategy} {}

  std::string_view peer() const override { return "icet"; }
  std::string_view schedule() const override { return strategyName(strategy_); }
  void setImage(const compositor::Subimage<Rgba>& mine) override {
    icet_->setImage(mine.frame, mine.active, mine.pixels);
  }
  std::span<const Rgba> composite(std::span<const Rank> order, Collect collect) override {
    return icet_->composite(strategy_, order, collect);
  }
  std::int64_t bytesSent() const override { return icet_->bytesSent(); }

 private:
  std::shared_ptr<IceT> icet_;
  IceTStrategy strategy_;
};

}  // namespace

Contenders icetContenders(const Communicator& comm, std::string& whyNot) {
  auto opened = IceT::open(comm, whyNot);
  if (!opened) return {};
  const auto icet = std::make_shared<IceT>(std::move(*opened));
  Contenders contenders;
  for (const IceTStrategy strategy : kIceTStrategies)
    contenders.push_back(std::make_unique<IceTContender>(icet, strategy));
  return contenders;
}

}  // namespace burin::host::bench
