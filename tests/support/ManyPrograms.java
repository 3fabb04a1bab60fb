import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.lang.reflect.InvocationTargetException;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Files;
import java.nio.file.Path;

/** The jar, once for each program, in one Java: PROGRAM.out is what it prints on PROGRAM. */
public class ManyPrograms {
    public static void main(String[] arguments) throws Exception {
        URL jar = Path.of(arguments[0]).toUri().toURL();
        PrintStream before = System.out;
        for (int i = 1; i < arguments.length; i++) {
            ByteArrayOutputStream kept = new ByteArrayOutputStream();
            try (URLClassLoader own = new URLClassLoader(new URL[] {jar}, ClassLoader.getPlatformClassLoader())) {
                System.setOut(new PrintStream(kept, true, "UTF-8"));
                own.loadClass("parser.SparcTranslator").getMethod("main", String[].class)
                    .invoke(null, (Object) new String[] {arguments[i], "-A", "-n", "0"});
            } catch (InvocationTargetException error) {
                return; // as the jar ends: what is left is for another Java
            } finally {
                System.setOut(before);
            }
            Files.write(Path.of(arguments[i] + ".out"), kept.toByteArray());
        }
    }
}
