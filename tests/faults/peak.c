/* SPDX-License-Identifier: MIT
 * peak REPORT PROGRAM arguments…: runs a program and writes "peak KiB, microseconds of CPU" to the
 * file REPORT. If Python started the program directly, its peak would include Python's memory. */
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char** argv) {
  if (argc < 3) return 126;
  FILE* report = fopen(argv[1], "we");
  if (report == NULL) return 126;
  pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* ends with this program if a time limit stops it */
    execv(argv[2], argv + 2);
    _exit(127);
  }
  int status = 0;
  struct rusage usage;
  if (child < 0 || wait4(child, &status, 0, &usage) != child) return 126;
  long long microseconds = (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) * 1000000LL +
                           usage.ru_utime.tv_usec + usage.ru_stime.tv_usec;
  fprintf(report, "%ld %lld\n", usage.ru_maxrss, microseconds);
  if (fclose(report) != 0) return 126;
  if (WIFSIGNALED(status)) { /* ends by the same signal, without a second core dump */
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  return WEXITSTATUS(status);
}
