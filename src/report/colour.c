#include "colour.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double clamp_unit(double t)
{
    return t > 0 ? (t < 1 ? t : 1) : 0;
}

static double srgb_of_linear(double c)
{
    c = clamp_unit(c);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* Oklab, in which equal steps look equal: B. Ottosson, "A perceptual color space for image processing", 2020. */
static pia_colour colour_of_oklch(double lightness, double chroma, double hue)
{
    double a = chroma * cos(hue * pi / 180), b = chroma * sin(hue * pi / 180);
    double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    return (pia_colour){srgb_of_linear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                        srgb_of_linear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                        srgb_of_linear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 1};
}

pia_colour pia_ramp_colour(pia_ramp ramp, double t)
{
    static const struct {
        double lightness[2], chroma[2], hue[2]; /* at t = 0 and t = 1; chroma swells by half its mean between */
    } ramps[] = {
        [PIA_RAMP_ERROR] = {{0.90, 0.30}, {0.09, 0.13}, {95, -50}}, [PIA_RAMP_HEIGHT] = {{0.36, 0.93}, {0.09, 0.09}, {275, 105}}};
    if (isnan(t)) return pia_colour_grey(0.7);
    t = clamp_unit(t);
    double lightness = ramps[ramp].lightness[0] + t * (ramps[ramp].lightness[1] - ramps[ramp].lightness[0]);
    double hue = ramps[ramp].hue[0] + t * (ramps[ramp].hue[1] - ramps[ramp].hue[0]);
    double chroma = ramps[ramp].chroma[0] + t * (ramps[ramp].chroma[1] - ramps[ramp].chroma[0]);
    chroma += 0.25 * (ramps[ramp].chroma[0] + ramps[ramp].chroma[1]) * sin(pi * t);
    return colour_of_oklch(lightness, chroma, hue);
}

pia_colour pia_colour_cycle(pia_index index)
{
    static const unsigned char set[][3] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}};
    const unsigned char *c = set[index % 6];
    return (pia_colour){c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, 1};
}

pia_colour pia_colour_grey(double level)
{
    return (pia_colour){level, level, level, 1};
}

pia_colour pia_colour_faded(pia_colour colour, double alpha)
{
    colour.alpha = alpha;
    return colour;
}

pia_colour pia_colour_lit(pia_colour colour, double light)
{
    double keep = light <= 1 ? light : 2 - light, white = light <= 1 ? 0 : light - 1;
    return (pia_colour){clamp_unit(keep * colour.red + white), clamp_unit(keep * colour.green + white),
                        clamp_unit(keep * colour.blue + white), colour.alpha};
}
