// What a fragment did, and with COUNT_SAMPLES the sums over all of them.

uint visited = 0u;     // samples looked up
uint shaded = 0u;      // of these, those that show something
uint inOccupied = 0u;  // of the former, those in macrocells that may be visible
uint leaps = 0u;       // over empty macrocells

#ifdef COUNT_SAMPLES
layout(std430, binding = 0) buffer Counters { uint visited, shaded, inOccupied, leaps; } counters;
#endif

// Once, by every fragment that did anything.
void addToCounters() {
#ifdef COUNT_SAMPLES
  atomicAdd(counters.visited, visited);
  atomicAdd(counters.shaded, shaded);
  atomicAdd(counters.inOccupied, inOccupied);
  atomicAdd(counters.leaps, leaps);
#endif
}
