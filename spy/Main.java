// SPDX-License-Identifier: BSD-3-Clause
package geomap_spy;

import java.awt.AWTError;
import java.awt.GraphicsEnvironment;
import lcm.spy.Spy;

/** LCM's lcm-spy, or one line that says what it lacks. */
public final class Main {
  private Main() {}

  public static void main(String[] arguments) {
    requireWindows();
    require("lcm.spy.Spy", "liblcm-java");
    require("info.monitorenter.gui.chart.ITrace2D", "libjchart2d-java");
    Spy.main(arguments);
  }

  private static void requireWindows() {
    if (System.getenv("DISPLAY") == null) fail("no display; use --text");
    if (GraphicsEnvironment.isHeadless()) {
      fail("this Java opens no windows; install default-jre, or use --text");
    }
    try {
      GraphicsEnvironment.getLocalGraphicsEnvironment().getDefaultScreenDevice();
    } catch (AWTError refused) {
      fail("no display; use --text (" + refused.getMessage() + ")");
    }
  }

  private static void require(String name, String debianPackage) {
    try {
      Class.forName(name, false, Main.class.getClassLoader());
    } catch (ClassNotFoundException missing) {
      fail("install " + debianPackage + ", or use --text");
    }
  }

  private static void fail(String reason) {
    System.err.println("geomap-spy: " + reason);
    System.exit(1);
  }
}
