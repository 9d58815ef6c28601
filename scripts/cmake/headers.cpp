// Owner of the precompiled headers (BurinTargets.cmake); says nothing itself.
