#pragma once

#include <cstddef>
#include <vector>

#include "burin/compositor/schedule.hpp"
#include "burin/compositor/workload.hpp"

namespace burin::compositor {

/// A network, in seconds, as in Alexandrov, Ionescu, Schauser, Scheiman, "LogGP: Incorporating Long
/// Messages into the LogP Model", SPAA 1995.
struct LogGP {
  double latency = 0.0;     ///< L: from one end of the wire to the other
  double overhead = 0.0;    ///< o: of the processor, per message sent and per message received
  double gap = 0.0;         ///< g: at least between two messages on one link
  double gapPerByte = 0.0;  ///< G: on one link
};

/// A processor, in seconds.
struct ComputeRates {
  double perCombinedPixel = 0.0;  ///< for each active pixel received
  double perEncodedByte = 0.0;    ///< on the sender, and again on the receiver
};

/// What a message weighs.
struct WireSize {
  double bytesPerPixel = 16.0;
  double bytesPerMessage = 40.0;
};

struct Machine {
  LogGP link;
  ComputeRates compute;
  int cores = 0;  ///< that all participants share; 0: each has one of its own
};

constexpr int kNoParticipant = -1;

/// What a schedule costs. Counts are of the composition, without the gather.
struct Prediction {
  double compositeSeconds = 0.0;  ///< until the last participant has finished
  double gatherSeconds = 0.0;     ///< from then until the root has all pieces
  double messages = 0.0;
  double bytes = 0.0;
  double mostMessages = 0.0;  ///< that one participant sends
  double mostSentBytes = 0.0;
  double mostReceivedBytes = 0.0;
  int mostRounds = 0;  ///< that one participant waits for
  double seconds() const { return compositeSeconds + gatherSeconds; }
};

/// Follows all participants through time. Each has a processor (one of `cores` if these are shared,
/// first come first served) that encodes, combines and spends the overheads; a link out and a link
/// in, which carry one message at a time while the processor goes on. A round combines when all of
/// it has arrived. Finished pieces then go to participant `root` (kNoParticipant: to somebody who
/// owns none), one at a time on its link in. The schedule must be sound (scheduleProblem), else
/// this throws. Memory and time grow with the number of messages: up to a few million.
Prediction predict(const LazySchedule& schedule, const ActivePixels& activePixels,
                   const WireSize& wire, const Machine& machine, int root = 0);

/// The same, following participant 0 only and taking the others to do what it does when it does it:
/// right where all are alike (direct send, swapping without a rest, any serial gather to 0; even
/// cuts and a Workload), close to it with a rest. For any number of participants. Counts are 0's,
/// times the participants for the totals.
Prediction predictAlike(const LazySchedule& schedule, const ActivePixels& activePixels,
                        const WireSize& wire, const Machine& machine, int root = 0);

}  // namespace burin::compositor
