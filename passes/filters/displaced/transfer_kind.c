#include "passes/filters/displaced/transfer_kind.h"

struct transfer_constants passes_transfer_constants(const relief *relief,
                                                    const transfer_kind *kind) {
    return (struct transfer_constants){.width = relief->constants.width,
                                       .height = relief->constants.height,
                                       .azimuths = kind->azimuths};
}

kind_specialisation passes_transfer_specialisation(const transfer_kind *kind) {
    return (kind_specialisation){{{SPECIALISE_TRANSFER_ORDER, kind->order},
                                  {SPECIALISE_TRANSFER_COLOURED, kind->coloured},
                                  {SPECIALISE_TRANSFER_WIDTHS, kind->widths},
                                  {SPECIALISE_TRANSFER_EMISSION, kind->emissive}}};
}
