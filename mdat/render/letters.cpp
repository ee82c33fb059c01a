// Letters of 5 by 9 dots, the last two rows below the line.
#include "mdat/render/picture.hpp"

namespace lasso::mdat {
namespace {

struct Letter {
  char character;
  const char* rows;  // from the top: a digit to the base of 32 each, its highest bit at the left; rows that are missing are empty
};

constexpr Letter kLetters[] = {
    {'0', "ehjlphe"},   {'1', "4c4444e"},   {'2', "eh1248v"},   {'3', "eh161he"},   {'4', "26aiv22"},   {'5', "vgu11he"}, {'6', "68guhhe"},
    {'7', "v124888"},   {'8', "ehhehhe"},   {'9', "ehhf12c"},   {'A', "ehhvhhh"},   {'B', "uhhuhhu"},   {'C', "ehggghe"}, {'D', "uhhhhhu"},
    {'E', "vgguggv"},   {'F', "vgguggg"},   {'G', "ehgnhhf"},   {'H', "hhhvhhh"},   {'I', "e44444e"},   {'J', "72222ic"}, {'K', "hikokih"},
    {'L', "ggggggv"},   {'M', "hrllhhh"},   {'N', "hhpljhh"},   {'O', "ehhhhhe"},   {'P', "uhhuggg"},   {'Q', "ehhhlid"}, {'R', "uhhukih"},
    {'S', "fgge11u"},   {'T', "v444444"},   {'U', "hhhhhhe"},   {'V', "hhhhha4"},   {'W', "hhhllla"},   {'X', "hha4ahh"}, {'Y', "hhha444"},
    {'Z', "v1248gv"},   {'a', "00e1fhf"},   {'b', "ggmphhu"},   {'c', "00ehghe"},   {'d', "11djhhf"},   {'e', "00ehvge"}, {'f', "698s888"},
    {'g', "00fhhhf1e"}, {'h', "ggmphhh"},   {'i', "40c444e"},   {'j', "2062222ic"}, {'k', "ggikoki"},   {'l', "c44444e"}, {'m', "00qllhh"},
    {'n', "00mphhh"},   {'o', "00ehhhe"},   {'p', "00uhhhugg"}, {'q', "00fhhhf11"}, {'r', "00mpggg"},   {'s', "00fge1u"}, {'t', "88s8896"},
    {'u', "00hhhjd"},   {'v', "00hhha4"},   {'w', "00hhlla"},   {'x', "00ha4ah"},   {'y', "00hhhhf1e"}, {'z', "00v248v"}, {' ', ""},
    {'.', "00000cc"},   {',', "00000cc48"}, {':', "0cc0cc0"},   {'-', "000v000"},   {'+', "044v440"},   {'/', "122488g"}, {'(', "2488842"},
    {')', "8422248"},   {'%', "op248j3"},   {'=', "00v0v00"},   {'\'', "4400000"},  {'_', "0000000v"},  {'<', "248g842"}, {'>', "8421248"},
    {'?', "eh12404"},   {'"', "aa00000"},   {'&', "cik8lid"},   {'#', "aavavaa"},   {';', "0cc00cc48"},
};

const Letter& letter_of(char character) {
  const Letter* unknown = nullptr;
  for (const Letter& letter : kLetters) {
    if (letter.character == character) return letter;
    if (letter.character == '?') unknown = &letter;
  }
  return *unknown;
}

int dots_of(char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; }

}  // namespace

void write(Picture& picture, int left, int top, const std::string& text, const Pixel& colour, int scale) {
  for (const char character : text) {
    int row = top;
    for (const char* digit = letter_of(character).rows; *digit != 0; ++digit, row += scale) {
      for (int dot = 0; dot < 5; ++dot) {
        if ((dots_of(*digit) >> (4 - dot) & 1) != 0) fill(picture, left + dot * scale, row, scale, scale, colour);
      }
    }
    left += kLetterWidth * scale;
  }
}

}  // namespace lasso::mdat
