/* Reads problem files with FCLIB, the reader that Siconos uses, and prints the sum of each list of numbers, taken in its order.
 *
 *   cc scripts/fclib_reader.c -lfclib -o reader && ./reader local|global FILE...
 *
 * FCLIB itself ends the program where a file lacks something.
 */
#include <fclib.h>
#include <stdio.h>
#include <string.h>

static void list(const char *name, const double *x, int n)
{
  double sum = 0.0;
  for (int k = 0; x && k < n; k++) sum += x[k];
  printf("%s %d %.17g\n", name, x ? n : 0, sum);
}

/* Triplets say how many entries there are; compressed columns and rows fill what they have. */
static void matrix(const char *name, const struct fclib_matrix *a)
{
  if (a) list(name, a->x, a->nz >= 0 ? a->nz : a->nzmax);
}

static void guesses(const char *path, int n)
{
  int count = 0;
  const struct fclib_solution *guess = fclib_read_guesses(path, &count);
  for (int g = 0; guess && g < count; g++) {
    char name[32];
    snprintf(name, sizeof name, "guesses/%d/r", g + 1);
    list(name, guess[g].r, n);
  }
}

int main(int count, char **words)
{
  for (int k = 2; k < count; k++) {
    printf("file %s\n", words[k]);
    if (strcmp(words[1], "local") == 0) {
      const struct fclib_local *p = fclib_read_local(words[k]);
      if (!p) return 1;
      matrix("W/x", p->W);
      list("vectors/q", p->q, p->W->m);
      list("vectors/mu", p->mu, p->W->m / p->spacedim);
      guesses(words[k], p->W->m);
    } else {
      const struct fclib_global *p = fclib_read_global(words[k]);
      if (!p) return 1;
      matrix("M/x", p->M);
      matrix("H/x", p->H);
      list("vectors/f", p->f, p->M->m);
      list("vectors/w", p->w, p->H->n);
      list("vectors/mu", p->mu, p->H->n / p->spacedim);
      guesses(words[k], p->H->n);
    }
  }
  return 0;
}
