#ifndef PASSES_MAPS_MEAN_RESULTANT_LENGTH_H
#define PASSES_MAPS_MEAN_RESULTANT_LENGTH_H

/// Length [0, 1) of the mean direction of a von Mises-Fisher distribution of concentration kappa
/// [0, infinity): coth kappa - 1/kappa. (Mardia, Jupp 2000, section 9.3.)
double passes_mean_resultant_length(double kappa);

#endif
