/* Figures of numbers, which Fortran's own output takes several times as long for. The interfaces are in text.f90. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_FIGURES = 40, MOST_LENGTH = MOST_FIGURES + 10 };

/* Significant figures of a finite number, `digits` of them, without sign and point, and its decimal exponent. */
void ehlwave_figures(double value, int digits, char figures[MOST_FIGURES], int *exponent)
{
   char text[MOST_LENGTH];
   const char *from = text;
   snprintf(text, sizeof text, "%.*e", digits - 1, value);
   if (*from == '-') from++;
   figures[0] = *from;
   if (digits > 1) from++;                /* the point */
   for (int i = 1; i < digits; i++) figures[i] = *++from;
   *exponent = atoi(from + 2);
}

/* How many figures, 15 to 17, read back as the same number; 17 where rounding could under- or overflow. */
int ehlwave_fewest_figures(double value)
{
   char text[MOST_LENGTH];
   if (fabs(value) < 1e-300 || fabs(value) > 1e300) return 17;
   for (int digits = 15; digits < 17; digits++) {
      snprintf(text, sizeof text, "%.*e", digits - 1, value);
      if (strtod(text, NULL) == value) return digits;
   }
   return 17;
}
