/* Texts of numbers, which Fortran's own output takes several times as long for. The interface is in text.f90. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FIGURES = 40, MOST_LENGTH = MOST_FIGURES + 10 };

/* Shortest of fixed and exponential notation of a finite number with so many significant figures, without zeros at the end, and its
   length. 0 digits: the fewest, 15 to 17, that read back as the same number; 17 where rounding could under- or overflow. */
void ehlwave_number_text(double value, int digits, char result[MOST_LENGTH], int *length)
{
   char text[MOST_LENGTH], *to = result, *figures = text;
   int is_free = digits == 0, kept;
   if (is_free) digits = fabs(value) < 1e-300 || fabs(value) > 1e300 ? 17 : 15;
   snprintf(text, sizeof text, "%.*e", digits - 1, value);
   while (is_free && digits < 17 && strtod(text, NULL) != value) snprintf(text, sizeof text, "%.*e", digits++, value);
   if (*figures == '-') *to++ = *figures++;
   if (digits > 1) {                       /* leave out the point */
      figures[1] = figures[0];
      figures++;
   }
   int exponent = atoi(figures + digits + 1);
   for (kept = digits; kept > 1 && figures[kept - 1] == '0';) kept--;
   int whole = exponent < 0 || exponent >= digits ? 1 : exponent + 1;   /* figures before the point */
   if (exponent < 0 && exponent >= -4) {
      whole = 0;
      to += sprintf(to, "0.%.*s", -exponent - 1, "000");
   } else {
      memcpy(to, figures, (size_t)whole);
      to += whole;
      if (kept > whole) *to++ = '.';
   }
   for (int i = whole; i < kept; i++) *to++ = figures[i];
   if (exponent < -4 || exponent >= digits) to += sprintf(to, "e%d", exponent);
   *length = (int)(to - result);
}
