/* Runs the programs beside which ours is measured. */
#ifndef PIA_BENCH_RUN_PEER_H
#define PIA_BENCH_RUN_PEER_H

/* Monotonic seconds. */
double run_peer_now(void);

/* Runs peer NAME on the case file, its standard output in the file `result`: `directory`/peer_NAME, or peer_NAME.py of `scripts` where
 * there is one. Returns 0 when it failed or took longer than `limit` seconds. */
int run_peer(const char *directory, const char *scripts, const char *name, const char *path, const char *result, double limit);

#endif
