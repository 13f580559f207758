// SPDX-License-Identifier: BSD-3-Clause
package strainwave.spy;

import info.monitorenter.gui.chart.labelformatters.LabelFormatterNumber;
import java.text.NumberFormat;
import java.util.regex.Pattern;

/** Numbers as people read them: no zero has a minus. */
public final class Numbers {
  private static final Pattern NEGATIVE_ZERO = Pattern.compile("-0([.,]0*)?(e[+-]?0+)?");

  private Numbers() {}

  /** String.format, where a value of which `format` shows nothing is a plain zero. */
  public static String text(String format, double value) {
    final String text = String.format(format, value);
    return NEGATIVE_ZERO.matcher(text).matches() ? String.format(format, 0.0) : text;
  }

  /** Labels of an axis. */
  static final class Labels extends LabelFormatterNumber {
    Labels() {
      super(NumberFormat.getInstance());
    }

    @Override
    public String format(double value) {
      final String text = super.format(value);
      return NEGATIVE_ZERO.matcher(text).matches() ? text.substring(1) : text;
    }
  }
}
